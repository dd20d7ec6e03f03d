#include "scene/scale.h"

#include "core/error.h"
#include "scene/load.h"
#include "scene/merge.h"

#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde {

static float largest(const glm::vec3& v) {
    return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)});
}

/// The exponent of two that brings `size` to 1 or a little more; 0 where it may stay.
static int wanted_exponent(float size) {
    const bool fits = size == 0.0f || (size >= SMALLEST_SIZE && size <= LARGEST_SIZE);
    return fits ? 0 : -std::ilogb(size);
}

static glm::mat4 even_scale(int exponent) {
    return glm::scale(glm::mat4(1.0f), glm::vec3(std::ldexp(1.0f, exponent)));
}

static void scale_mesh(Scene& scene, uint32_t index) {
    float size = 0.0f;
    for (const glm::vec3& p : scene.meshes[index].positions) size = std::max(size, largest(p));
    const int exponent = wanted_exponent(size);
    if (exponent == 0) return;
    for (glm::vec3& p : scene.meshes[index].positions) p *= std::ldexp(1.0f, exponent);
    for (Instance& instance : scene.instances)
        if (instance.mesh == index) instance.object_to_world *= even_scale(-exponent);
}

static float size_of(const Scene& scene) {
    const SceneBounds bounds = scene_bounds(scene);
    const float size = std::max(largest(bounds.low), largest(bounds.high));
    if (!std::isfinite(size))
        throw InputError("the scene is larger than 1e38 units; scale it down");
    return size;
}

int bring_to_scale(Scene& scene, std::optional<int> wanted) {
    constexpr int MOST = 40; // of two, at once, so that squares of the scale are no denormals
    int scaled = 0;
    const auto missing = [&] {
        const int own = wanted_exponent(size_of(scene));
        return std::clamp(wanted ? *wanted - scaled : own, -MOST, MOST);
    };
    while (const int exponent = missing()) {
        const float scale = std::ldexp(1.0f, exponent);
        place_anew(scene, even_scale(exponent));
        for_each_light_list(scene, [&](auto& lights, const auto&, const char*) {
            for (auto& light : lights)
                if constexpr (requires { light.intensity; }) light.intensity *= scale * scale;
        });
        for (Material& material : scene.materials)
            if (material.attenuation_distance) *material.attenuation_distance *= scale;
        for_each_medium(scene, [&](Medium& medium) {
            for (glm::vec3* rate : {&medium.absorption, &medium.scattering, &medium.emission})
                *rate /= scale;
        });
        if (scene.environment.ground) *scene.environment.ground *= scale;
        scaled += exponent;
    }
    for (uint32_t i = 0; i < scene.meshes.size(); ++i) scale_mesh(scene, i);
    if (scaled == 0) return 0;
    scene.notes.push_back(
        fmt::format("The scene is {} for the digits of floats: all its lengths "
                    "were multiplied by {:.3g}, which leaves its picture as it is.",
                    scaled < 0 ? "too large" : "too small", std::ldexp(1.0, scaled)));
    return scaled;
}

} // namespace onde
