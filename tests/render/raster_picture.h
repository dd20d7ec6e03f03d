// Scenes for the depth buffer and the painter, and their pictures.
#pragma once

#include "chapter/raster_depth_buffer.h"
#include "kernels/columns.h"
#include "render/picture.h"

#include <glm/gtc/matrix_transform.hpp>

namespace onde::test {

/// Looks down the -Z axis from (0, 0, 10); y is up, 4 units from top to bottom.
inline Camera front_camera(float height = 4) {
    Camera camera = camera_at({0, 0, 10}, {0, 0, 0}, 0.7f);
    camera.orthographic_height = height;
    return camera;
}

inline Scene empty_raster_scene() {
    Scene scene;
    scene.cameras = {front_camera()};
    scene.chapter.whitted.background = glm::vec3(0.125f, 0.25f, 0.5f);
    scene.environment.radiance = glm::vec3(1);
    return scene;
}

/// Every material has a colour of its own: the first component counts them.
inline uint32_t add_color(Scene& scene) {
    Material material;
    const auto number = uint32_t(scene.materials.size());
    material.base_color = glm::vec3(float(number + 1) / 4096.0f, 0.5f, float(number % 7) / 8.0f);
    scene.materials.push_back(material);
    return number;
}

inline void add_triangle(Scene& scene, glm::vec3 a, glm::vec3 b, glm::vec3 c, uint32_t material) {
    Mesh mesh;
    mesh.positions = {a, b, c};
    mesh.triangles = {{0, 1, 2}};
    mesh.materials = {material};
    scene.meshes.push_back(mesh);
    scene.instances.push_back({uint32_t(scene.meshes.size() - 1), glm::mat4(1)});
}

/// A rectangle facing the camera at height z.
inline void add_card(Scene& scene, glm::vec2 low, glm::vec2 high, float z, uint32_t material) {
    add_triangle(scene, {low.x, low.y, z}, {high.x, low.y, z}, {high.x, high.y, z}, material);
    add_triangle(scene, {low.x, low.y, z}, {high.x, high.y, z}, {low.x, high.y, z}, material);
}

inline glm::vec3 random_vector(Generator& generator, float size) {
    const auto number = [&] { return size * (2 * unit(generator) - 1); };
    const float x = number(), y = number(), z = number();
    return {x, y, z};
}

/// Turned, stretched and half of them mirrored copies of one mesh.
inline void add_placed_copies(Scene& scene, Generator& generator, int copies) {
    Mesh mesh;
    for (int i = 0; i < 24; i++) mesh.positions.push_back(random_vector(generator, 0.5f));
    for (uint32_t i = 0; i < 24; i += 3) {
        mesh.triangles.push_back({i, i + 1, i + 2});
        mesh.materials.push_back(add_color(scene));
    }
    scene.meshes.push_back(mesh);
    for (int i = 0; i < copies; i++) {
        const glm::vec3 axis = random_vector(generator, 1) + glm::vec3(0, 0, 1.5f);
        glm::mat4 place = glm::rotate(glm::mat4(1), 6 * unit(generator), glm::normalize(axis));
        place = glm::scale(place, glm::vec3(i % 2 ? -1 : 1, 0.5f + unit(generator), 1.5f));
        place[3] = glm::vec4(random_vector(generator, 2), 1);
        scene.instances.push_back({uint32_t(scene.meshes.size() - 1), place});
    }
}

/// Triangles of every size and balls, thrown at random through each other.
inline Scene random_raster_scene(uint32_t seed) {
    Generator generator(seed);
    Scene scene = empty_raster_scene();
    for (int i = 0; i < 150; i++) {
        const glm::vec3 center = random_vector(generator, 2.5f);
        const float size = i < 5 ? 6.0f : i < 40 ? 1.0f : 0.2f;
        const glm::vec3 b = random_vector(generator, size), c = random_vector(generator, size);
        add_triangle(scene, center, center + b, center + c, add_color(scene));
    }
    add_placed_copies(scene, generator, 6);
    for (int i = 0; i < 12; i++) {
        const glm::vec3 center = random_vector(generator, 2.0f);
        scene.spheres.push_back({center, 0.1f + 0.5f * unit(generator), add_color(scene)});
    }
    return scene;
}

inline RenderOptions raster_options(IntegratorKind kind, uint32_t width = 96, uint32_t height = 80,
                                    uint32_t samples = 1) {
    RenderOptions options = small_options(width, height, samples);
    options.integrator = kind;
    return options;
}

inline Image
draw_depth(const Scene& scene, DepthAtomics atomics,
           const RenderOptions& options = raster_options(IntegratorKind::depth_buffer)) {
    const DeviceScene placed = place_on_device(scene);
    return take_picture(
               *make_depth_buffer({programs(), &scene, placed, scene.cameras[0], options, nullptr},
                                  atomics),
               options)
        .image;
}

inline glm::vec3 color_at(const Image& image, uint32_t x, uint32_t y) {
    const float* p = &image.pixels[3 * (size_t(y) * image.width + x)];
    return {p[0], p[1], p[2]};
}

/// The first pixel that differs, with both colours; empty when there is none.
inline std::string first_pixel_difference(const Image& a, const Image& b) {
    for (uint32_t y = 0; y < a.height; y++)
        for (uint32_t x = 0; x < a.width; x++)
            if (const glm::vec3 p = color_at(a, x, y), q = color_at(b, x, y); p != q)
                return fmt::format("pixel {},{}: {} {} {} instead of {} {} {}", x, y, p.x, p.y, p.z,
                                   q.x, q.y, q.z);
    return {};
}

} // namespace onde::test
