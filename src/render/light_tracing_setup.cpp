#include "render/light_tracing_setup.h"

#include "render/film_contents.h"
#include "scene/load.h"
#include "scene/phong.h"
#include "shared/scene.h"

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

/// Beside the brightest light, since a point light's own number is no radiance, and light gathers.
constexpr double HEADROOM = 1024;

float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

double brightest_light(const Scene& scene) {
    float brightest = 1e-30f;
    for (const Material& material : scene.materials)
        brightest = std::max(brightest, largest(material.emission));
    for_each_light_list(scene, [&](const auto& lights, const auto&, const char*) {
        for (const auto& light : lights)
            for_each_field(light, [&]<class Value>(const auto& field, const Value& value) {
                if constexpr (std::is_same_v<Value, glm::vec3>)
                    if (field.rules.form == Form::color)
                        brightest = std::max(brightest, largest(value));
            });
    });
    for (const DirectionalLight& light : scene.directional_lights)
        if (has_size(light)) {
            const float sine = std::sin(0.5f * light.angle); // its radiance is seen
            brightest = std::max(brightest, largest(light.irradiance) / (3.0f * sine * sine));
        }
    for (const PhotometricLight& light : scene.photometric_lights)
        brightest = std::max(brightest, largest(light.intensity) *
                                            *std::ranges::max_element(light.profile.candela));
    float pixel = 1;
    if (const auto& map = scene.environment.map; map && !map->pixels.empty())
        pixel = *std::ranges::max_element(map->pixels);
    return std::max(brightest, largest(scene.environment.radiance) * pixel);
}

} // namespace

LightTracingRecord make_light_tracing(const Scene& scene, const RenderOptions& options) {
    const SceneBounds bounds = scene_bounds(scene);
    const glm::vec3 center = 0.5f * (bounds.low + bounds.high);
    LightTracingRecord record{};
    for (uint32_t k = 0; k < 3; k++) record.center[k] = center[glm::length_t(k)];
    record.radius = std::max(0.5f * glm::length(bounds.high - bounds.low) * 1.001f, 1e-6f);
    const double paths = double(FILM_BLOCK) * options.width * options.height;
    const double most = paths * brightest_light(scene) * HEADROOM;
    record.splat_scale = std::ldexp(1.0f, std::clamp(64 - std::ilogb(most) - 1, -100, 100));
    return record;
}

uint64_t count_hidden_emitters(const PackedScene& scene) {
    const auto hidden = [&](const SurfaceRecord& surface) {
        const MaterialRecord& material = scene.materials[SURFACE_MATERIAL(surface.any.tag)];
        return surface.any.light == LIGHT_UNLISTED &&
               material.texture[TEXTURE_EMISSION] == NO_INDEX;
    };
    return uint64_t(std::ranges::count_if(scene.surfaces, hidden));
}

bool has_smooth_lobes(const Scene& scene) {
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        const Material material = path_material(scene, i);
        if (material.kind != MaterialKind::diffuse &&
            material.roughness * material.roughness < SMOOTH_ALPHA)
            return true;
    }
    return false;
}

} // namespace onde
