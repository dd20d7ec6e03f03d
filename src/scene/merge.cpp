#include "scene/merge.h"

#include "core/error.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace onde {

template <class T>
static uint32_t move_to_end(std::vector<T>& whole, std::vector<T>& part) {
    const size_t first = whole.size();
    whole.insert(whole.end(), std::make_move_iterator(part.begin()),
                 std::make_move_iterator(part.end()));
    part.clear();
    return uint32_t(first);
}

/// Adds what `part` states by index to `whole`, whose list begins at `first` for it.
template <class T>
static void take_shifted(std::map<uint32_t, T>& whole, const std::map<uint32_t, T>& part,
                         size_t first) {
    for (const auto& [index, value] : part) whole[uint32_t(first) + index] = value;
}

static void take_grid(Medium& medium, uint32_t first) {
    if (medium.grid != NO_GRID) medium.grid += first;
}

AssetOffsets append_assets(Scene& whole, Scene& part) {
    AssetOffsets offsets{.textures = move_to_end(whole.textures, part.textures),
                         .materials = move_to_end(whole.materials, part.materials),
                         .meshes = move_to_end(whole.meshes, part.meshes),
                         .names = move_to_end(whole.names, part.names),
                         .grids = move_to_end(whole.grids, part.grids)};
    for (size_t i = offsets.materials; i < whole.materials.size(); ++i) {
        Material& material = whole.materials[i];
        for_each_texture(material, [&](const auto&, int32_t& texture) {
            if (texture != NO_TEXTURE) texture += int32_t(offsets.textures);
        });
        if (auto& other = material.blend_with) *other += offsets.materials;
        if (material.medium) take_grid(*material.medium, offsets.grids);
        offsets.media.push_back(material.medium.value_or(Medium{}).placement);
    }
    for (size_t i = offsets.textures; i < whole.textures.size(); ++i)
        if (int32_t& same = whole.textures[i].same_image_as; same != NO_TEXTURE)
            same += int32_t(offsets.textures);
    take_shifted(whole.chapter.phong, part.chapter.phong, offsets.materials);
    for (size_t i = offsets.meshes; i < whole.meshes.size(); ++i)
        for (uint32_t& material : whole.meshes[i].materials) material += offsets.materials;
    return offsets;
}

static glm::vec3 transform_point(const glm::mat4& transform, const glm::vec3& point) {
    return glm::vec3(transform * glm::vec4(point, 1.0f));
}

float even_scale(const glm::mat4& transform) {
    const glm::vec3 x(transform[0]), y(transform[1]), z(transform[2]);
    const float scale = glm::length(x), tolerance = 1e-3f * scale;
    const bool same_length = std::abs(glm::length(y) - scale) <= tolerance &&
                             std::abs(glm::length(z) - scale) <= tolerance;
    const float shear =
        std::max({std::abs(glm::dot(x, y)), std::abs(glm::dot(y, z)), std::abs(glm::dot(z, x))});
    return same_length && shear <= tolerance * scale ? scale : 0.0f;
}

static bool is_light(const Scene& scene, uint32_t material) {
    const glm::vec3 e = scene.materials[material].emission;
    return e.x > 0 || e.y > 0 || e.z > 0;
}

/// Evenly scaled spheres stay spheres; others become shapes. A stretched light is refused.
static void place_sphere(Scene& whole, Sphere sphere, const glm::mat4& transform) {
    const float scale = even_scale(transform);
    if (scale > 0.0f) {
        sphere.center = transform_point(transform, sphere.center);
        sphere.radius *= scale;
        whole.spheres.push_back(sphere);
        return;
    }
    if (is_light(whole, sphere.material))
        throw InputError("a sphere that is a light cannot be stretched; scale it evenly or use a "
                         "mesh");
    glm::mat4 placed(1.0f);
    for (glm::length_t k = 0; k < 3; ++k) placed[k][k] = sphere.radius;
    placed[3] = glm::vec4(sphere.center, 1.0f);
    whole.shapes.push_back(
        {ShapeKind::sphere, sphere.material, 0.25f, transform * placed, sphere.name});
}

glm::mat4 rigid_part(const glm::mat4& transform) {
    const glm::dvec3 back = glm::normalize(glm::dvec3(glm::vec3(transform[2])));
    glm::dvec3 right{glm::vec3(transform[0])};
    right = glm::normalize(right - back * glm::dot(right, back));
    const glm::dvec3 up = glm::cross(back, right);
    return glm::mat4(glm::vec4(glm::vec3(right), 0.0f), glm::vec4(glm::vec3(up), 0.0f),
                     glm::vec4(glm::vec3(back), 0.0f), transform[3]);
}

Camera placed(Camera camera, const glm::mat4& transform) {
    const float scale = std::cbrt(std::abs(glm::determinant(glm::mat3(transform))));
    camera.camera_to_world = rigid_part(transform * camera.camera_to_world);
    for_each_field(camera, [&]<class Value>(const auto& field, Value& value) {
        if (field.rules.form != Form::length) return;
        if constexpr (std::is_same_v<Value, float>) value *= scale;
        if constexpr (std::is_same_v<Value, std::optional<float>>)
            if (value) *value *= scale;
    });
    return camera;
}

static AreaLight placed(AreaLight light, const glm::mat4& transform, uint32_t first_material) {
    const glm::mat3 linear(transform);
    light.position = transform_point(transform, light.position);
    light.edge1 = linear * light.edge1;
    light.edge2 = linear * light.edge2;
    light.radius *= glm::length(glm::vec3(transform[0]));
    light.material += first_material;
    return light;
}

static Environment placed(Environment environment, const glm::mat4& transform) {
    if (auto& ground = environment.ground) *ground = *ground * transform[1].y + transform[3].y;
    return environment;
}

bool emits(const Environment& environment) {
    return environment.radiance.x > 0.0f || environment.radiance.y > 0.0f ||
           environment.radiance.z > 0.0f;
}

static void take_missing(RenderSettings& whole, const RenderSettings& part) {
    for_each_entry<RenderSettings>([&](const auto& field) {
        if (!(whole.*field.member)) whole.*field.member = part.*field.member;
    });
}

/// [whitted] is taken as a whole, from the including scene first.
static void take_whitted(Scene& whole, const ChapterScene& part) {
    static const std::string left_out =
        "The [whitted] settings of an included scene are left out: others come first.";
    ChapterScene& chapter = whole.chapter;
    if (!part.states_whitted) return;
    if (!chapter.states_whitted)
        chapter.whitted = part.whitted;
    else if (part.whitted != chapter.whitted &&
             std::ranges::find(whole.notes, left_out) == whole.notes.end())
        whole.notes.push_back(left_out);
    chapter.states_whitted = true;
}

static void append_lights(Scene& whole, const Scene& part, const AssetOffsets& offsets,
                          const glm::mat4& transform) {
    ChapterScene& chapter = whole.chapter;
#define ONDE_APPEND(Type, list, words)                                                             \
    take_shifted(chapter.intensities.list, part.chapter.intensities.list, whole.list.size());      \
    for (const Type& light : part.list) whole.list.push_back(placed(light, transform));
    LIGHT_LISTS(ONDE_APPEND)
#undef ONDE_APPEND
    for (const AreaLight& light : part.chapter.area_lights)
        chapter.area_lights.push_back(placed(light, transform, offsets.materials));
}

static void place_media(Scene& whole, const Scene& part, const AssetOffsets& offsets,
                        const glm::mat4& transform) {
    for (size_t i = 0; i < offsets.media.size(); ++i)
        if (auto& medium = whole.materials[offsets.materials + i].medium)
            medium->placement = transform * offsets.media[i];
    if (whole.medium != Medium{}) return;
    whole.medium = placed(part.medium, transform);
    take_grid(whole.medium, offsets.grids);
}

static size_t count_lights(const Scene& scene) {
    size_t lights = scene.chapter.area_lights.size();
    for_each_light_list(scene,
                        [&](const auto& list, const auto&, const char*) { lights += list.size(); });
    return lights;
}

uint64_t placed_bytes(const Scene& part) {
    constexpr uint64_t LIGHT_BYTES = 256; // a light, what the chapter says of it, its record
    return count_lights(part) * LIGHT_BYTES + part.instances.size() * 4 * sizeof(Instance) +
           part.spheres.size() * 4 * sizeof(Sphere) + part.shapes.size() * 4 * sizeof(Shape) +
           part.cameras.size() * 2 * sizeof(Camera);
}

void append_placed(Scene& whole, const Scene& part, const AssetOffsets& offsets,
                   const glm::mat4& transform) {
    if (whole.instances.size() + part.instances.size() > MAX_PLACED ||
        whole.spheres.size() + part.spheres.size() > MAX_PLACED ||
        whole.shapes.size() + part.shapes.size() > MAX_PLACED ||
        count_lights(whole) + count_lights(part) > MAX_PLACED ||
        whole.cameras.size() + part.cameras.size() > MAX_PLACED)
        throw InputError("the includes add up to more than {} instances, spheres, shapes, lights "
                         "or cameras; include fewer",
                         MAX_PLACED);
    const auto name = [&](uint32_t own) { return own == NO_NAME ? own : own + offsets.names; };
    for (const Instance& instance : part.instances)
        whole.instances.push_back({instance.mesh + offsets.meshes,
                                   transform * instance.object_to_world, name(instance.name)});
    for (Sphere sphere : part.spheres) {
        sphere.material += offsets.materials;
        sphere.name = name(sphere.name);
        place_sphere(whole, sphere, transform);
    }
    for (Shape shape : part.shapes) {
        shape.material += offsets.materials;
        shape.name = name(shape.name);
        shape.object_to_world = transform * shape.object_to_world;
        whole.shapes.push_back(shape);
    }
    append_lights(whole, part, offsets, transform);
    for (const Camera& camera : part.cameras) whole.cameras.push_back(placed(camera, transform));
    place_media(whole, part, offsets, transform);
    if (!emits(whole.environment)) whole.environment = placed(part.environment, transform);
    take_missing(whole.settings, part.settings);
    take_whitted(whole, part.chapter);
}

void place_anew(Scene& scene, const glm::mat4& transform) {
    for (Instance& instance : scene.instances)
        instance.object_to_world = transform * instance.object_to_world;
    for (Shape& shape : scene.shapes) shape.object_to_world = transform * shape.object_to_world;
    for (const Sphere& sphere : std::exchange(scene.spheres, {}))
        place_sphere(scene, sphere, transform);
    for_each_light_list(scene, [&](auto& lights, const auto&, const char*) {
        for (auto& light : lights) light = placed(light, transform);
    });
    for (AreaLight& light : scene.chapter.area_lights) light = placed(light, transform, 0);
    for (Camera& camera : scene.cameras) camera = placed(camera, transform);
    for_each_medium(scene, [&](Medium& medium) { medium = placed(medium, transform); });
}

void append(Scene& whole, Scene&& part, const glm::mat4& transform) {
    const AssetOffsets offsets = append_assets(whole, part);
    append_placed(whole, part, offsets, transform);
    move_to_end(whole.notes, part.notes);
}

} // namespace onde
