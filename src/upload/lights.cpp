#include "upload/lights.h"

#include "scene/load.h"
#include "upload/alias_table.h"

#include <algorithm>
#include <numbers>
#include <numeric>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

double luminance(glm::vec3 c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

void copy(float (&to)[3], glm::vec3 from) {
    for (uint32_t k = 0; k < 3; k++) to[k] = from[k];
}

struct WeightedLights {
    std::vector<LightRecord> records;
    std::vector<double> power;

    void add(const LightRecord& record, double weight) {
        records.push_back(record);
        power.push_back(weight);
    }
};

void add_primitive(const Scene& scene, const EmissivePrimitive& e, WeightedLights& lights) {
    const Material& material = scene.materials[e.material];
    LightRecord record{};
    record.kind = e.sphere ? LIGHT_SPHERE : LIGHT_TRIANGLE;
    copy(record.position, e.position);
    copy(record.edge1, e.edge1);
    copy(record.edge2, e.edge2);
    record.material = e.material;
    record.surface = e.primitive;
    record.orientation = e.orientation;
    const double area = e.sphere ? 4 * PI * double(e.radius) * e.radius
                                 : 0.5 * glm::length(glm::cross(e.edge1, e.edge2));
    record.area = e.sphere ? e.radius : float(area);
    const double faces = !e.sphere && material.two_sided ? 2 : 1;
    lights.add(record, PI * area * faces * luminance(material.emission));
}

/// The environment's mean radiance, by luminance, weighted by solid angle.
double mean_radiance(const Environment& environment) {
    if (!environment.map) return luminance(environment.radiance);
    const Image& map = *environment.map;
    double sum = 0, weight = 0;
    for (uint32_t y = 0; y < map.height; y++) {
        const double sine = std::sin(PI * (y + 0.5) / map.height);
        for (uint32_t x = 0; x < map.width; x++) {
            const auto pixel = map.pixel(x, y);
            sum += sine * luminance(environment.radiance * glm::vec3(pixel[0], pixel[1], pixel[2]));
        }
        weight += sine * map.width;
    }
    return sum / weight;
}

void add_environment(const Scene& scene, double scene_radius, WeightedLights& lights) {
    const double mean = mean_radiance(scene.environment);
    if (!(mean > 0)) return;
    const double others = std::accumulate(lights.power.begin(), lights.power.end(), 0.0);
    const double power = 4 * PI * PI * scene_radius * scene_radius * mean;
    LightRecord record{};
    record.kind = LIGHT_ENVIRONMENT;
    lights.add(record, others > 0 ? std::clamp(power, others / 3, others * 3) : 1.0);
}

} // namespace

LightList build_lights(const Scene& scene, FlatGeometry& flat) {
    const SceneBounds bounds = scene_bounds(scene);
    const double radius = std::max(0.5 * double(glm::length(bounds.high - bounds.low)), 1e-6);
    WeightedLights lights;
    for (const EmissivePrimitive& e : flat.emissive) {
        flat.surfaces[e.primitive].light = uint32_t(lights.records.size());
        add_primitive(scene, e, lights);
    }
    for (const PointLight& light : scene.point_lights) {
        LightRecord record{};
        record.kind = LIGHT_POINT;
        copy(record.position, light.position);
        copy(record.radiance, light.intensity);
        lights.add(record, 4 * PI * luminance(light.intensity));
    }
    for (const DirectionalLight& light : scene.directional_lights) {
        LightRecord record{};
        record.kind = LIGHT_DIRECTIONAL;
        copy(record.position, light.to_light);
        copy(record.radiance, light.irradiance);
        lights.add(record, PI * radius * radius * luminance(light.irradiance));
    }
    const size_t finite = lights.records.size();
    add_environment(scene, radius, lights);

    LightList list;
    if (lights.records.size() > finite) list.environment = uint32_t(finite);
    const std::vector<AliasRecord> alias = build_alias_table(lights.power);
    for (size_t i = 0; i < alias.size(); i++) {
        lights.records[i].pmf = alias[i].pmf;
        lights.records[i].alias_below = alias[i].below;
        lights.records[i].alias = alias[i].alias;
    }
    list.records = std::move(lights.records);
    return list;
}

} // namespace onde
