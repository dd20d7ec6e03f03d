#include "upload/lights.h"

#include "scene/light_groups.h"
#include "scene/load.h"
#include "upload/alias_table.h"
#include "upload/light_tree.h"
#include "upload/profile.h"
#include "upload/textures.h"
#include "upload/words.h"

#include <glm/gtc/quaternion.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;

/// With fewer lights that have a place the tree does not pay for its time.
constexpr size_t ENOUGH_FOR_TREE = 12;

double luminance(glm::vec3 c) {
    return 0.2126 * c.x + 0.7152 * c.y + 0.0722 * c.z;
}

struct WeightedLights {
    LightGroups groups;
    std::vector<LightRecord> records{};
    std::vector<double> power{};
    std::vector<uint32_t> profiles{}; ///< words

    void add(LightRecord record, double weight, const std::string& group) {
        record.group = groups(group);
        records.push_back(record);
        power.push_back(weight);
    }
};

/// A vertex's coordinates in the set that a texture uses.
glm::vec2 vertex_uv(const Texture& texture, const FlatGeometry& flat, uint32_t vertex) {
    const std::vector<uint32_t>& sets = flat.uv_sets;
    const size_t set = size_t(std::ranges::find(sets, texture.uv_set) - sets.begin());
    const float* uv = flat.vertices[vertex].uv;
    if (set > 0) uv = &flat.uvs[2 * (vertex * (sets.size() - 1) + set - 1)];
    return {uv[0], uv[1]};
}

/// Mean luminance of a triangle's emission texture, from its nearest texels at a grid of points.
double mean_texture(const Scene& scene, int32_t index, const FlatGeometry& flat,
                    const TriangleSurface& surface) {
    constexpr int STEPS = 12;
    static const std::vector<float> linear = srgb_table();
    const Texture& texture = scene.textures[size_t(index)];
    const TexelImage& image = image_of(scene.textures, texture);
    const auto texel = [&](float t, uint32_t size) {
        return std::min(uint32_t((t - std::floor(t)) * float(size)), size - 1);
    };
    glm::vec2 uv[3];
    for (int k = 0; k < 3; k++)
        uv[k] = texture.transform(vertex_uv(texture, flat, surface.vertex[k]));
    double sum = 0;
    int count = 0;
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; i + j < STEPS; j++, count++) {
            const float b1 = (float(i) + 0.33f) / STEPS, b2 = (float(j) + 0.33f) / STEPS;
            const glm::vec2 at_uv = uv[0] * (1 - b1 - b2) + uv[1] * b1 + uv[2] * b2;
            const size_t at =
                size_t(texel(at_uv.y, image.height)) * image.width + texel(at_uv.x, image.width);
            const auto channel = [&](size_t c) {
                return image.is_linear() ? image.floats[4 * at + c]
                                         : linear[image.rgba[4 * at + c]];
            };
            sum += luminance({channel(0), channel(1), channel(2)});
        }
    return sum / count;
}

/// The luminance of the emission, averaged over the primitive.
double mean_emission(const Scene& scene, const FlatGeometry& flat, const EmissivePrimitive& e) {
    const Material& material = scene.materials[e.material];
    const double factor = luminance(material.emission);
    const bool triangle = e.light && e.light->kind == LIGHT_TRIANGLE;
    if (!triangle || material.emission_texture == NO_TEXTURE) return factor;
    const TriangleSurface& surface = flat.surfaces[e.primitive].triangle;
    return factor * mean_texture(scene, material.emission_texture, flat, surface);
}

void add_primitive(const Scene& scene, FlatGeometry& flat, const EmissivePrimitive& e,
                   WeightedLights& lights) {
    const double emission = mean_emission(scene, flat, e);
    uint32_t& listed = flat.surfaces[e.primitive].any.light;
    listed = emission > 0 && e.light ? uint32_t(lights.records.size()) : LIGHT_UNLISTED;
    if (listed == LIGHT_UNLISTED) return;
    const bool both = e.light->kind != LIGHT_SPHERE && scene.materials[e.material].two_sided;
    lights.add(*e.light, PI * e.area * (both ? 2 : 1) * emission,
               scene.materials[e.material].group);
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

/// Scales the lights from `first` on down to the sum of those before, where there are any.
void limit_to_others(WeightedLights& lights, size_t first) {
    const auto middle = lights.power.begin() + ptrdiff_t(first);
    const double others = std::accumulate(lights.power.begin(), middle, 0.0);
    const double own = std::accumulate(middle, lights.power.end(), 0.0);
    if (others > 0 && own > others)
        for (auto power = middle; power != lights.power.end(); ++power) *power *= others / own;
}

void add_point(const PointLight& light, WeightedLights& lights) {
    LightRecord record{};
    record.kind = LIGHT_POINT;
    copy(record.as.point.position, light.position);
    copy(record.as.point.intensity, light.intensity);
    lights.add(record, 4 * PI * luminance(light.intensity), light.group);
}

void add_spot(const SpotLight& light, WeightedLights& lights) {
    LightRecord record{};
    record.kind = LIGHT_SPOT;
    copy(record.as.spot.position, light.position);
    copy(record.as.spot.back, light.back);
    copy(record.as.spot.intensity, light.intensity);
    const double outer = std::cos(double(light.half_angle));
    const double width = std::max(std::cos(double(light.inner_angle)) - outer, 1e-3);
    record.as.spot.opening = float(1 - outer);
    record.as.spot.steepness = float(1 / width);
    const double angle = 2 * PI * std::max(1 - outer - width + width / 3, width / 3);
    lights.add(record, angle * luminance(light.intensity), light.group);
}

/// From a profile's space, whose z is its axis and whose x is where angles around it begin.
glm::quat turn_of(const PhotometricLight& light) {
    const glm::vec3 z = -light.back;
    glm::vec3 x = light.start - z * glm::dot(z, light.start);
    if (!(glm::length(x) > 1e-6f * glm::length(light.start)))
        x = glm::cross(z, std::abs(z.x) < 0.5f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0));
    x = glm::normalize(x);
    return glm::normalize(glm::quat_cast(glm::mat3(x, glm::cross(z, x), z)));
}

void add_photometric(const std::vector<PhotometricLight>& all, WeightedLights& lights) {
    std::map<std::vector<uint32_t>, uint32_t> first_words; // lamps of a kind share theirs
    for (const PhotometricLight& light : all) {
        const double power = 4 * PI * mean_of(light.profile) * luminance(light.intensity);
        std::vector<uint32_t>& words = lights.profiles;
        const auto [known, is_new] =
            first_words.try_emplace(pack_profile(light.profile), uint32_t(words.size()));
        if (is_new) words.insert(words.end(), known->first.begin(), known->first.end());
        LightRecord record{};
        record.kind = LIGHT_PHOTOMETRIC;
        record.surface = known->second;
        copy(record.as.photometric.position, light.position);
        copy(record.as.photometric.intensity, light.intensity);
        const glm::quat turn = turn_of(light);
        copy(record.as.photometric.turn, glm::vec4(turn.x, turn.y, turn.z, turn.w));
        record.as.photometric.opening = opening_of(light.profile);
        lights.add(record, power, light.group);
    }
}

void add_directional(const DirectionalLight& light, double scene_radius, WeightedLights& lights) {
    LightRecord record{};
    if (has_size(light)) {
        record.kind = LIGHT_SUN;
        const double sine = std::sin(0.5 * double(light.angle));
        const double half = std::sin(0.25 * double(light.angle));
        copy(record.as.sun.to_light, light.to_light);
        copy(record.as.sun.radiance, glm::vec3(glm::dvec3(light.irradiance) / (PI * sine * sine)));
        record.as.sun.opening = float(2 * half * half);
    } else {
        record.kind = LIGHT_DIRECTIONAL;
        copy(record.as.directional.to_light, light.to_light);
        copy(record.as.directional.irradiance, light.irradiance);
    }
    lights.add(record, PI * scene_radius * scene_radius * luminance(light.irradiance), light.group);
}

/// What of the environment's light meets a sphere around the scene.
double environment_power(const Scene& scene, double scene_radius) {
    return 4 * PI * PI * scene_radius * scene_radius * mean_radiance(scene.environment);
}

void add_environment(const Scene& scene, double scene_radius, WeightedLights& lights) {
    const double power = environment_power(scene, scene_radius);
    if (!(power > 0)) return;
    const double others = std::accumulate(lights.power.begin(), lights.power.end(), 0.0);
    LightRecord record{};
    record.kind = LIGHT_ENVIRONMENT;
    lights.add(record, others > 0 ? std::clamp(power, others / 3, others) : 1.0,
               scene.environment.group);
}

/// Whether it is a surface, which rays can find.
bool has_surface(const LightRecord& light) {
    return light.kind == LIGHT_TRIANGLE || light.kind == LIGHT_DISK || light.kind == LIGHT_SPHERE;
}

/// The power of each of the local lights, the first, in a tree. The dimmest surfaces, together a
/// hundredth of all, get none: textures have many that are all but black, and make trees deep.
std::vector<double> powers_in_tree(const WeightedLights& lights, size_t local) {
    constexpr double DIM_SHARE = 0.01;
    std::vector<double> powers(lights.power.begin(), lights.power.begin() + ptrdiff_t(local));
    const double all = std::accumulate(powers.begin(), powers.end(), 0.0);
    std::vector<uint32_t> surfaces;
    for (uint32_t i = 0; i < local; i++)
        if (has_surface(lights.records[i])) surfaces.push_back(i);
    std::ranges::sort(surfaces, [&](uint32_t a, uint32_t b) {
        return std::pair(powers[a], a) < std::pair(powers[b], b);
    });
    double dim = 0;
    for (const uint32_t i : surfaces) {
        if (dim + powers[i] > DIM_SHARE * all) break;
        dim += powers[i];
        powers[i] = 0;
    }
    if (dim > 0)
        for (double& power : powers) power *= all / (all - dim); // together they stay as likely
    return powers;
}

std::vector<LightBounds> bounds_of(const Scene& scene, const WeightedLights& lights,
                                   const std::vector<double>& powers) {
    std::vector<LightBounds> bounds;
    for (size_t i = 0; i < powers.size(); i++) {
        const LightRecord& light = lights.records[i];
        const bool two_sided = has_surface(light) && scene.materials[light.material].two_sided;
        bounds.push_back(onde::bounds_of(light, two_sided, powers[i]));
    }
    return bounds;
}

/// The lights that a tree is for: all that have power in it, but for details that emission textures
/// show, where an environment is far stronger than all of them.
size_t count_for_tree(const Scene& scene, const WeightedLights& lights,
                      const std::vector<double>& powers, double from_environment) {
    constexpr double DIM_SHARE = 0.02;
    const double all = std::accumulate(powers.begin(), powers.end(), 0.0);
    const bool is_dim = all < DIM_SHARE * from_environment;
    size_t count = 0;
    for (size_t i = 0; i < powers.size(); i++) {
        const LightRecord& light = lights.records[i];
        const bool is_detail = is_dim && has_surface(light) &&
                               scene.materials[light.material].emission_texture != NO_TEXTURE;
        count += powers[i] > 0 && !is_detail;
    }
    return count;
}

void add_tree(const Scene& scene, const WeightedLights& lights, std::vector<double> powers,
              LightList& list) {
    const double total = std::accumulate(lights.power.begin(), lights.power.end(), 0.0);
    std::vector<double> everywhere(lights.power.begin() + ptrdiff_t(powers.size()),
                                   lights.power.end());
    for (double& power : everywhere) power /= total;
    for (double& power : powers) power /= total;
    LightTree tree = build_light_tree(bounds_of(scene, lights, powers), everywhere);
    for (size_t i = 0; i < list.records.size(); i++) list.records[i].trail = tree.trails[i];
    list.tree = std::move(tree.branches);
}

} // namespace

LightList build_lights(const Scene& scene, FlatGeometry& flat, LightSampler sampler) {
    const SceneBounds bounds = scene_bounds(scene);
    const double radius = std::max(0.5 * double(glm::length(bounds.high - bounds.low)), 1e-6);
    WeightedLights lights{LightGroups(scene)};
    for (const EmissivePrimitive& e : flat.emissive) add_primitive(scene, flat, e, lights);
    for (const PointLight& light : scene.point_lights) add_point(light, lights);
    for (const SpotLight& light : scene.spot_lights) add_spot(light, lights);
    add_photometric(scene.photometric_lights, lights);
    const size_t local = lights.records.size();
    for (const DirectionalLight& light : scene.directional_lights)
        if (!has_size(light)) add_directional(light, radius, lights);
    LightList list;
    list.suns.first = uint32_t(lights.records.size());
    for (const DirectionalLight& light : scene.directional_lights)
        if (has_size(light)) add_directional(light, radius, lights);
    list.suns.count = uint32_t(lights.records.size()) - list.suns.first;
    limit_to_others(lights, local);
    const size_t finite = lights.records.size();
    add_environment(scene, radius, lights);

    list.profiles = std::move(lights.profiles);
    if (lights.records.size() > finite) list.environment = uint32_t(finite);
    const std::vector<AliasEntry> alias = build_alias_table(lights.power);
    for (size_t i = 0; i < alias.size(); i++) {
        lights.records[i].pmf = alias[i].pmf;
        lights.records[i].alias_below = alias[i].below;
        lights.records[i].alias = alias[i].alias;
    }
    list.records = lights.records;
    if (sampler == LightSampler::power) return list;
    std::vector<double> powers = powers_in_tree(lights, local);
    const size_t count = count_for_tree(scene, lights, powers, environment_power(scene, radius));
    if (sampler == LightSampler::tree || count >= ENOUGH_FOR_TREE)
        add_tree(scene, lights, std::move(powers), list);
    return list;
}

} // namespace onde
