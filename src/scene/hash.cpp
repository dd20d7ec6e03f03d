#include "core/hash.h"
#include "scene/load.h"

namespace onde {

namespace {

template <class T>
void add(Hasher& hasher, const std::vector<T>& values) {
    hasher.span(std::span<const T>(values));
}

void add(Hasher& hasher, const Texture& texture) {
    hasher.value(texture.image.width).value(texture.image.height);
    hasher.value(uint32_t(texture.srgb)).value(texture.wrap_u).value(texture.wrap_v);
    add(hasher, texture.image.rgba);
}

void add(Hasher& hasher, const Material& m) {
    hasher.value(m.kind).value(m.base_color).value(m.roughness).value(m.metallic).value(m.ior);
    hasher.value(m.emission).value(uint32_t(m.two_sided)).value(m.base_color_texture);
    hasher.value(m.metallic_roughness_texture).value(m.emission_texture).value(m.normal_texture);
    hasher.value(m.normal_scale);
    hasher.value(m.phong);
}

void add(Hasher& hasher, const std::optional<glm::vec2>& v) {
    hasher.value(uint32_t(v.has_value())).value(v.value_or(glm::vec2(0.0f)));
}
void add(Hasher& hasher, const std::optional<glm::vec3>& v) {
    hasher.value(uint32_t(v.has_value())).value(v.value_or(glm::vec3(0.0f)));
}

void add(Hasher& hasher, const WhittedSettings& w) {
    add(hasher, w.ambient);
    add(hasher, w.background);
    hasher.value(uint32_t(w.saturate)).value(uint32_t(w.source_reflectivity));
    hasher.value(uint32_t(w.distance_falloff)).value(uint32_t(w.fresnel));
    hasher.value(w.epsilon).value(w.wavelengths);
}

void add(Hasher& hasher, const Mesh& mesh) {
    add(hasher, mesh.positions);
    add(hasher, mesh.normals);
    add(hasher, mesh.uvs);
    add(hasher, mesh.triangles);
    add(hasher, mesh.materials);
}

void add(Hasher& hasher, const Camera& camera) {
    hasher.value(camera.camera_to_world).value(camera.vertical_fov);
    hasher.value(camera.aperture_radius).value(camera.focus_distance);
    hasher.value(camera.orthographic_height);
    hasher.value(uint32_t(camera.screen.has_value()));
    if (!camera.screen) return;
    hasher.value(camera.screen->size).value(camera.screen->distance);
    add(hasher, camera.screen->first_pixel);
}

void add(Hasher& hasher, const Environment& environment) {
    hasher.value(environment.radiance).value(environment.rotation);
    hasher.value(uint32_t(environment.map.has_value()));
    if (!environment.map) return;
    hasher.value(environment.map->width).value(environment.map->height);
    add(hasher, environment.map->pixels);
}

template <class T>
void add_each(Hasher& hasher, const std::vector<T>& values) {
    hasher.value(uint64_t(values.size()));
    for (const T& value : values) add(hasher, value);
}

} // namespace

std::string scene_hash(const Scene& scene) {
    // Plain structs of 4-byte members are hashed whole; they have no padding.
    static_assert(sizeof(Instance) == 17 * 4 && sizeof(Sphere) == 5 * 4);
    static_assert(sizeof(Shape) == 19 * 4);
    static_assert(sizeof(PointLight) == 9 * 4 && sizeof(DirectionalLight) == 9 * 4);
    static_assert(sizeof(AreaLight) == 17 * 4 && sizeof(Phong) == 7 * 4);
    Hasher hasher;
    add_each(hasher, scene.textures);
    add_each(hasher, scene.materials);
    add_each(hasher, scene.meshes);
    add(hasher, scene.instances);
    add(hasher, scene.spheres);
    add(hasher, scene.shapes);
    add(hasher, scene.point_lights);
    add(hasher, scene.directional_lights);
    add(hasher, scene.area_lights);
    add(hasher, scene.whitted);
    add(hasher, scene.environment);
    add_each(hasher, scene.cameras);
    return hasher.hex();
}

} // namespace onde
