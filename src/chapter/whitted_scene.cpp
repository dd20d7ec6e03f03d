#include "chapter/whitted_scene.h"

#include "scene/phong.h"
#include "shared/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace onde {
namespace {

void copy(float (&to)[3], glm::vec3 from) {
    for (uint32_t k = 0; k < 3; k++) to[k] = from[k];
}

// Fraunhofer lines in micrometres: by these an Abbe number is defined.
constexpr double BLUE_F = 0.4861, YELLOW_D = 0.5876, RED_C = 0.6563;

/// Cauchy's B, per square micrometre.
float dispersion(float ior, std::optional<float> abbe) {
    if (!abbe) return 0.0f;
    return float((ior - 1.0) / (*abbe * (1 / (BLUE_F * BLUE_F) - 1 / (RED_C * RED_C))));
}

/// Wyman, Sloan and Shirley, "Simple analytic approximations to the CIE XYZ color matching
/// functions", 2013: the multi-lobe fit. Nanometres.
glm::dvec3 observer(double w) {
    const auto lobe = [w](double mean, double below, double above) {
        const double t = (w - mean) / (w < mean ? below : above);
        return std::exp(-0.5 * t * t);
    };
    return {1.056 * lobe(599.8, 37.9, 31.0) + 0.362 * lobe(442.0, 16.0, 26.7) -
                0.065 * lobe(501.1, 20.4, 26.2),
            0.821 * lobe(568.8, 46.9, 40.5) + 0.286 * lobe(530.9, 16.3, 31.1),
            1.217 * lobe(437.0, 11.8, 36.0) + 0.681 * lobe(459.0, 26.0, 13.8)};
}

/// Linear sRGB (IEC 61966-2-1), negative components set to 0.
glm::dvec3 srgb_of(const glm::dvec3& xyz) {
    const glm::dmat3 rows({3.2406, -1.5372, -0.4986}, {-0.9689, 1.8758, 0.0415},
                          {0.0557, -0.2040, 1.0570});
    return glm::max(glm::transpose(rows) * xyz, glm::dvec3(0));
}

void set_wavelengths(WhittedRecord& record, uint32_t count) {
    record.wavelengths = count;
    std::array<glm::dvec3, MAX_WAVELENGTHS> filters;
    glm::dvec3 sum(0);
    for (uint32_t j = 0; j < count; j++) {
        const double w = 0.42 + 0.26 * (j + 0.5) / count;
        record.bend[j] = float(1 / (w * w) - 1 / (YELLOW_D * YELLOW_D));
        filters[j] = srgb_of(observer(1000 * w));
        sum += filters[j];
    }
    for (uint32_t j = 0; j < count; j++)
        for (uint32_t k = 0; k < 3; k++) record.filter[3 * j + k] = float(filters[j][k] / sum[k]);
}

WhittedRecord pack_settings(const Scene& scene, uint32_t depth) {
    const WhittedSettings& w = scene.chapter.whitted;
    WhittedRecord record{};
    copy(record.ambient, w.ambient.value_or(scene.environment.radiance));
    record.has_background = w.background.has_value();
    copy(record.background, w.background.value_or(glm::vec3(0.0f)));
    record.epsilon = w.epsilon;
    record.saturate = w.saturate;
    record.source_reflectivity = w.reflectivity == Reflectivity::source;
    record.distance_falloff = w.distance_falloff;
    record.fresnel = w.fresnel;
    record.max_depth = depth;
    set_wavelengths(record, w.wavelengths);
    return record;
}

PhongRecord pack_phong(const Scene& scene, uint32_t material) {
    const Material& m = scene.materials[material];
    const Phong p = phong_of(scene, material);
    PhongRecord record{};
    copy(record.color, m.base_color);
    record.texture = m.base_color_texture < 0 ? NO_INDEX : uint32_t(m.base_color_texture);
    record.ambient = p.ambient;
    record.diffuse = p.diffuse;
    record.specular = p.specular;
    record.exponent = p.exponent;
    record.reflection = p.reflection;
    record.transmission = p.transmission;
    record.ior = m.ior;
    record.dispersion = dispersion(m.ior, p.abbe);
    return record;
}

SourceRecord source(uint32_t kind, glm::vec3 position, glm::vec3 intensity) {
    SourceRecord record{};
    record.kind = kind;
    copy(record.position, position);
    copy(record.intensity, intensity);
    record.samples = 1;
    return record;
}

SourceRecord pack_area_light(const AreaLight& light) {
    static_assert(uint32_t(AreaLightKind::disk) == SOURCE_DISK);
    static_assert(uint32_t(AreaLightKind::sphere) == SOURCE_SPHERE);
    SourceRecord record = source(uint32_t(light.kind), light.position, light.intensity);
    copy(record.edge1, light.edge1);
    copy(record.edge2, light.edge2);
    record.radius = light.radius;
    record.two_sided = light.two_sided;
    record.samples = light.samples;
    return record;
}

} // namespace

std::vector<std::string> PackedWhitted::defines() const {
    return {fmt::format("ONDE_TRANSLUCENT={:d}", translucent),
            fmt::format("ONDE_DISPERSION={:d}", dispersive)};
}

PackedWhitted pack_whitted(const Scene& scene, uint32_t depth) {
    PackedWhitted packed;
    packed.settings = pack_settings(scene, depth);
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        packed.phong.push_back(pack_phong(scene, i));
        packed.translucent |= packed.phong.back().transmission > 0;
        packed.dispersive |= packed.phong.back().dispersion > 0;
    }
    for (uint32_t i = 0; i < scene.point_lights.size(); i++)
        packed.sources.push_back(
            source(SOURCE_POINT, scene.point_lights[i].position, point_intensity(scene, i)));
    for (uint32_t i = 0; i < scene.directional_lights.size(); i++)
        packed.sources.push_back(source(SOURCE_DIRECTIONAL, scene.directional_lights[i].to_light,
                                        directional_intensity(scene, i)));
    for (const AreaLight& light : scene.chapter.area_lights)
        packed.sources.push_back(pack_area_light(light));
    packed.settings.source_count = uint32_t(packed.sources.size());
    return packed;
}

} // namespace onde
