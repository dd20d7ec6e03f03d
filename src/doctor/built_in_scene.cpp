#include "doctor/built_in_scene.h"

#include "scene/load.h"
#include "scene/shapes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde::doctor {

namespace {

glm::mat4 moved(glm::vec3 by, float scale = 1) {
    return glm::scale(glm::translate(glm::mat4(1.0f), by), glm::vec3(scale));
}

/// By index: the order in which they are added.
enum Materials : uint32_t { FLOOR, WALL, CLAY, GLASS, STEEL, MIRROR, GLOW };

Material material_of(MaterialKind kind, glm::vec3 color, float roughness) {
    Material material;
    material.kind = kind;
    material.base_color = color;
    material.roughness = roughness;
    return material;
}

std::vector<Material> materials() {
    std::vector<Material> all{
        material_of(MaterialKind::metallic_roughness, glm::vec3(1), 0.4f),
        material_of(MaterialKind::diffuse, {0.7f, 0.4f, 0.3f}, 1),
        material_of(MaterialKind::metallic_roughness, {0.3f, 0.5f, 0.8f}, 0.5f),
        material_of(MaterialKind::dielectric, glm::vec3(0.95f), 0),
        material_of(MaterialKind::conductor, {0.9f, 0.7f, 0.4f}, 0.3f),
        material_of(MaterialKind::conductor, glm::vec3(0.9f), 0),
        material_of(MaterialKind::diffuse, glm::vec3(0), 1)};
    all[FLOOR].base_color_texture = 0;
    all[FLOOR].normal_texture = 1;
    all[CLAY].metallic = 0.3f;
    all[GLOW].emission = {9, 8, 6};
    all[GLOW].two_sided = false;
    return all;
}

/// Tiles of two colours that go on beyond the edges, and waves as a map of normals.
std::vector<Texture> textures() {
    constexpr uint32_t SIDE = 8;
    std::vector<Texture> all(2);
    for (uint32_t i = 0; i < SIDE * SIDE; ++i) {
        const bool dark = (i / SIDE / 4 + i % SIDE / 4) % 2;
        const auto shade = uint8_t(dark ? 40 : 200 + i % 5);
        all[0].image.rgba.insert(all[0].image.rgba.end(),
                                 {shade, uint8_t(shade - 10), uint8_t(shade + 20), 255});
        const auto slope = uint8_t(128 + 40 * (int(i % 4) - 1));
        all[1].image.rgba.insert(all[1].image.rgba.end(), {slope, 128, 240, 255});
    }
    for (Texture& texture : all) texture.image.width = texture.image.height = SIDE;
    all[0].wrap_u = Wrap::mirror;
    all[1].srgb = false;
    return all;
}

/// A saddle with the normals of its curve.
Mesh saddle() {
    constexpr uint32_t CELLS = 6;
    Mesh mesh;
    for (uint32_t row = 0; row <= CELLS; ++row)
        for (uint32_t column = 0; column <= CELLS; ++column) {
            const float x = 2.0f * float(column) / CELLS - 1, z = 2.0f * float(row) / CELLS - 1;
            mesh.positions.emplace_back(x, 0.4f * (x * x - z * z), z);
            mesh.normals.push_back(glm::normalize(glm::vec3(-0.8f * x, 1, 0.8f * z)));
            if (row == CELLS || column == CELLS) continue;
            const uint32_t a = row * (CELLS + 1) + column, b = a + CELLS + 1;
            mesh.triangles.emplace_back(a, b, a + 1);
            mesh.triangles.emplace_back(a + 1, b, b + 1);
        }
    mesh.materials.assign(mesh.triangles.size(), CLAY);
    return mesh;
}

Image sky() {
    Image map(16, 8, 3);
    for (uint32_t i = 0; i < 16 * 8; ++i)
        for (uint32_t k = 0; k < 3; ++k)
            map.pixels[3 * i + k] = 0.1f + 0.02f * float((i * 7 + k * 3) % 11);
    map.pixel(5, 2)[0] = map.pixel(5, 2)[1] = 12;
    return map;
}

void add_things(Scene& scene) {
    scene.meshes = {rectangle_mesh({-3, 0, 3}, {6, 0, 0}, {0, 0, -6}, FLOOR),
                    rectangle_mesh({-3, 0, -3}, {6, 0, 0}, {0, 3, 0}, WALL),
                    rectangle_mesh({-3, 0, 3}, {0, 0, -6}, {0, 3, 0}, MIRROR), saddle(),
                    rectangle_mesh({-0.5f, 3.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}, GLOW)};
    for (glm::vec2& uv : scene.meshes[0].uvs) uv = 3.0f * uv - 0.7f;
    for (uint32_t mesh : {0u, 1u, 2u, 4u}) scene.instances.push_back({mesh, glm::mat4(1.0f)});
    scene.instances.push_back({3, moved({-1.2f, 0.6f, -1.2f}, 0.9f)});
    scene.instances.push_back(
        {3, glm::rotate(moved({1.5f, 1.6f, -1.8f}, 0.7f), 1.1f, glm::vec3(1, 0, 0.3f))});
    scene.spheres = {{{0.9f, 0.7f, 0.6f}, 0.7f, GLASS}, {{-2, 2.4f, -2}, 0.25f, GLOW}};
    scene.shapes = {{ShapeKind::torus, STEEL, 0.3f, moved({-1.1f, 0.3f, 0.9f}, 0.7f)},
                    {ShapeKind::disk, GLOW, 0.25f,
                     glm::rotate(moved({2.4f, 2.2f, 0}, 0.3f), 2.6f, glm::vec3(0, 0, 1))}};
}

void add_lights(Scene& scene) {
    scene.point_lights = {{{2, 2.5f, 2}, {4, 4, 5}}};
    scene.spot_lights = {{{-2, 3, 2}, glm::normalize(glm::vec3(-1, 2, 1)), {20, 16, 12}}};
    scene.directional_lights = {{glm::normalize(glm::vec3(0.4f, 1, 0.6f)), {0.4f, 0.4f, 0.5f}}};
    scene.environment = {glm::vec3(1), sky(), 0.4f};
}

Camera camera() {
    const glm::vec3 eye(1.6f, 2.1f, 5.6f), target(-0.2f, 0.8f, 0);
    Camera camera;
    camera.camera_to_world = glm::inverse(glm::lookAt(eye, target, glm::vec3(0, 1, 0)));
    camera.vertical_fov = 0.75f;
    camera.aperture_radius = 0.05f;
    camera.focus_distance = 5.5f;
    return camera;
}

} // namespace

Scene built_in_scene() {
    Scene scene;
    scene.textures = textures();
    scene.materials = materials();
    add_things(scene);
    add_lights(scene);
    scene.cameras = {camera()};
    complete_scene(scene);
    check_scene(scene);
    return scene;
}

} // namespace onde::doctor
