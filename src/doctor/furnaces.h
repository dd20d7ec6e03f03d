// Scenes whose pictures have closed forms.
#pragma once

#include "scene/shapes.h"

#include <cmath>

namespace onde::doctor {

/// A camera at `position` that looks at `target` with +Y up (or +Z where it looks along Y).
inline Camera camera_at(glm::vec3 position, glm::vec3 target, float vertical_fov) {
    const glm::vec3 back = glm::normalize(position - target);
    const glm::vec3 up = std::abs(back.y) > 0.99f ? glm::vec3(0, 0, 1) : glm::vec3(0, 1, 0);
    const glm::vec3 right = glm::normalize(glm::cross(up, back));
    Camera camera;
    camera.camera_to_world = glm::mat4(glm::vec4(right, 0), glm::vec4(glm::cross(back, right), 0),
                                       glm::vec4(back, 0), glm::vec4(position, 1));
    camera.vertical_fov = vertical_fov;
    return camera;
}

inline Material furnace_material(MaterialKind kind, glm::vec3 color, float roughness) {
    Material material;
    material.kind = kind;
    material.base_color = color;
    material.roughness = roughness;
    return material;
}

/// A unit sphere of one material that fills the middle of the picture, in a uniform white world.
inline Scene furnace(const Material& material) {
    Scene scene;
    scene.materials = {material};
    scene.spheres = {{glm::vec3(0), 1.0f, 0}};
    scene.environment.radiance = glm::vec3(1);
    scene.cameras = {camera_at({0, 0, 4}, {0, 0, 0}, 0.4f)};
    return scene;
}

/// The inside of a diffuse box that emits what it does not reflect: radiance is 1 everywhere.
inline Scene glowing_box(glm::vec3 albedo) {
    Scene scene;
    scene.materials = {furnace_material(MaterialKind::diffuse, albedo, 1)};
    scene.materials[0].emission = glm::vec3(1) - albedo;
    scene.meshes = {box_mesh(glm::vec3(2), 0)};
    scene.instances = {{0, glm::mat4(1)}};
    scene.cameras = {camera_at({0.2f, 0.1f, 0.5f}, {0, 0, 0}, 0.7f)};
    return scene;
}

/// A diffuse floor y = 0 seen from straight above through a narrow lens near the origin.
inline Scene floor_seen_from_above(float albedo) {
    Scene scene;
    scene.materials = {furnace_material(MaterialKind::diffuse, glm::vec3(albedo), 1)};
    Mesh floor;
    floor.positions = {{-2, 0, -1.5f}, {0, 0, 3}, {2, 0, -1.5f}}; // small: rays start above it by
                                                                  // its rounding
    floor.triangles = {{0, 1, 2}};
    floor.materials = {0};
    scene.meshes = {floor};
    scene.instances = {{0, glm::mat4(1)}};
    scene.cameras = {camera_at({0, 0.5f, 0}, {0, 0, 0}, 0.002f)};
    return scene;
}

inline void add_square_light(Scene& scene, float half, float height, float radiance) {
    Material light = furnace_material(MaterialKind::diffuse, glm::vec3(0), 1);
    light.emission = glm::vec3(radiance);
    light.two_sided = false;
    scene.materials.push_back(light);
    const auto material = uint32_t(scene.materials.size() - 1);
    Mesh square; // its front looks down
    square.positions = {
        {-half, height, -half}, {half, height, -half}, {half, height, half}, {-half, height, half}};
    square.triangles = {{0, 1, 2}, {0, 2, 3}};
    square.materials = {material, material};
    scene.meshes.push_back(square);
    scene.instances.push_back({uint32_t(scene.meshes.size() - 1), glm::mat4(1)});
}

/// Irradiance at the foot of the axis of a square light (Siegel and Howell, Thermal Radiation Heat
/// Transfer, configuration 3: four corner-to-point factors).
inline double irradiance_below_square(double half, double height, double radiance) {
    const double a = half / height;
    const double corner = a / std::sqrt(1 + a * a) * std::atan(a / std::sqrt(1 + a * a)) / M_PI;
    return 4 * corner * M_PI * radiance;
}

} // namespace onde::doctor
