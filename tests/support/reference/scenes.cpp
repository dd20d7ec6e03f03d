#include "support/reference/scenes.h"

#include <utility>

namespace onde::reference {

Camera look_at(const glm::vec3& eye, const glm::vec3& target, float vertical_fov) {
    const glm::vec3 back = glm::normalize(eye - target);
    const glm::vec3 up =
        std::abs(back.y) > 0.999f ? glm::vec3(0.0f, 0.0f, -1.0f) : glm::vec3(0.0f, 1.0f, 0.0f);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    Camera camera;
    camera.vertical_fov = vertical_fov;
    camera.camera_to_world =
        glm::mat4(glm::vec4(right, 0.0f), glm::vec4(glm::cross(back, right), 0.0f),
                  glm::vec4(back, 0.0f), glm::vec4(eye, 1.0f));
    return camera;
}

Mesh parallelogram(const glm::vec3& p, const glm::vec3& a, const glm::vec3& b, uint32_t material) {
    Mesh mesh;
    mesh.positions = {p, p + a, p + a + b, p + b};
    mesh.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials = {material, material};
    return mesh;
}

uint32_t add_mesh(Scene& scene, Mesh mesh, const glm::mat4& object_to_world) {
    const auto index = uint32_t(scene.meshes.size());
    scene.meshes.push_back(std::move(mesh));
    scene.instances.push_back({index, object_to_world});
    return index;
}

Material diffuse(const glm::vec3& albedo) {
    Material m;
    m.base_color = albedo;
    return m;
}

Material conductor(const glm::vec3& reflectance, float roughness) {
    Material m;
    m.kind = MaterialKind::conductor;
    m.base_color = reflectance;
    m.roughness = roughness;
    return m;
}

Material glass(float ior, float roughness) {
    Material m;
    m.kind = MaterialKind::dielectric;
    m.base_color = glm::vec3(1.0f);
    m.ior = ior;
    m.roughness = roughness;
    return m;
}

Material emitter(const glm::vec3& radiance) {
    Material m = diffuse(glm::vec3(0.0f));
    m.emission = radiance;
    m.two_sided = false;
    return m;
}

Scene furnace(const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.spheres = {{glm::vec3(0.0f), 1.0f, 0}};
    scene.environment.radiance = glm::vec3(1.0f);
    scene.cameras = {look_at({0, 0, 4}, {0, 0, 0}, 0.4f)};
    return scene;
}

Scene box_room(const Material& material) {
    Scene s;
    s.materials = {diffuse(glm::vec3(0.7f)), diffuse({0.6f, 0.1f, 0.1f}),
                   diffuse({0.1f, 0.6f, 0.1f}), emitter(glm::vec3(6.0f)), material};
    add_mesh(s, parallelogram({-1, -1, 1}, {2, 0, 0}, {0, 0, -2}, 0));
    add_mesh(s, parallelogram({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}, 0));
    add_mesh(s, parallelogram({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}, 0));
    add_mesh(s, parallelogram({-1, -1, 1}, {0, 0, -2}, {0, 2, 0}, 1));
    add_mesh(s, parallelogram({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 2));
    add_mesh(s, parallelogram({-0.4f, 0.95f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}, 3));
    s.spheres = {{{0.2f, -0.5f, 0.1f}, 0.5f, 4}};
    s.cameras = {look_at({0, 0, 3.6f}, {0, 0, 0}, 0.7f)};
    return s;
}

} // namespace onde::reference
