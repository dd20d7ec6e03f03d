#include "core/hash.h"
#include "scene/load.h"

namespace onde {

namespace {

void add(Hasher& hasher, const std::string&) {
    (void)hasher; // names change no pixel, but for those of groups
}

void add(Hasher& hasher, bool value) {
    hasher.value(uint32_t(value));
}

void add(Hasher& hasher, const NextInstance& instance) {
    hasher.value(instance.object_to_world).value(instance.steps.value_or(0));
    hasher.value(uint32_t(instance.steps.has_value()));
}

/// Numbers, vectors, matrices and enums: plain bytes.
template <class T>
requires(std::is_trivially_copyable_v<T> && !Fielded<T>) void add(Hasher& hasher, const T& value) {
    hasher.value(value);
}

void add(Hasher& hasher, const Image& image) {
    hasher.value(image.width).value(image.height).span(std::span<const float>(image.pixels));
}

void add(Hasher& hasher, const Texture& texture) {
    hasher.value(texture.filter).value(texture.uv_set).value(texture.transform);
    hasher.value(texture.same_image_as);
    hasher.value(texture.image.width).value(texture.image.height);
    hasher.value(uint32_t(texture.srgb)).value(texture.wrap_u).value(texture.wrap_v);
    hasher.span(std::span<const uint8_t>(texture.image.rgba));
    hasher.span(std::span<const uint8_t>(texture.image.low));
}

template <class T>
void add_span(Hasher& hasher, const std::vector<T>& values) {
    hasher.span(std::span<const T>(values));
}

void add(Hasher& hasher, const Mesh& mesh) {
    add_span(hasher, mesh.positions);
    add_span(hasher, mesh.normals);
    add_span(hasher, mesh.uvs);
    hasher.value(uint64_t(mesh.more_uvs.size()));
    for (const std::vector<glm::vec2>& uvs : mesh.more_uvs) add_span(hasher, uvs);
    add_span(hasher, mesh.colors);
    add_span(hasher, mesh.tangents);
    add_span(hasher, mesh.triangles);
    add_span(hasher, mesh.materials);
}

void add(Hasher& hasher, const DensityGrid& grid) {
    hasher.value(grid.table).value(grid.low).value(grid.high).value(grid.from_samples);
    add_span(hasher, grid.bricks);
    add_span(hasher, grid.samples);
}

template <class T>
void add(Hasher& hasher, const std::optional<T>& value);

/// Every member of its table.
template <Fielded T>
void add(Hasher& hasher, const T& thing) {
    for_each_field(thing, [&]<class Value>(const auto& field, const Value& value) {
        if constexpr (std::is_same_v<Value, std::string>)
            if (field.rules.form == Form::group) hasher.text(value);
        if (field.rules.form != Form::name) add(hasher, value);
    });
}

template <class T>
void add(Hasher& hasher, const std::optional<T>& value) {
    add(hasher, value.has_value());
    if (value) add(hasher, *value);
}

template <class T>
void add(Hasher& hasher, const std::vector<T>& values) {
    hasher.value(uint64_t(values.size()));
    for (const T& value : values) add(hasher, value);
}

template <class T>
void add(Hasher& hasher, const std::map<uint32_t, T>& values) {
    hasher.value(uint64_t(values.size()));
    for (const auto& [index, value] : values) {
        hasher.value(index);
        add(hasher, value);
    }
}

} // namespace

std::string next_frame_hash(const NextFrame& next) {
    Hasher hasher;
    add(hasher, next.cameras);
    add(hasher, next.instances);
    for (const std::vector<glm::vec3>& steps : next.steps) add_span(hasher, steps);
    hasher.value(next.environment_rotation);
    return hasher.hex();
}

std::string scene_hash(const Scene& scene) {
    Hasher hasher;
    add(hasher, scene.textures);
    add(hasher, scene.materials);
    add(hasher, scene.meshes);
    add(hasher, scene.instances);
    add(hasher, scene.spheres);
    add(hasher, scene.shapes);
    for_each_light_list(scene,
                        [&](const auto& list, const auto&, const char*) { add(hasher, list); });
    add(hasher, scene.environment);
    add(hasher, scene.medium);
    add(hasher, scene.grids);
    add(hasher, scene.cameras);
    add(hasher, scene.chapter.phong);
    for_each_light_list(scene, [&](const auto&, const auto& intensities, const char*) {
        add(hasher, intensities);
    });
    add(hasher, scene.chapter.area_lights);
    add(hasher, scene.chapter.whitted);
    return hasher.hex();
}

} // namespace onde
