// Scenes of media, and what is seen of them against what should be.
#pragma once

#include "render/same_bits.h"

#include <glm/gtc/matrix_transform.hpp>

namespace onde::test {

/// The boundary of a medium that bends no light.
inline Material boundary(const Medium& medium) {
    Material material = doctor::furnace_material(MaterialKind::dielectric, glm::vec3(1), 0);
    material.ior = 1;
    material.medium = medium;
    return material;
}

/// The mean of each channel, and its standard error by the pixels.
struct Seen {
    glm::dvec3 mean{0}, error{0};
    explicit Seen(const Image& image) {
        const size_t count = image.pixels.size() / image.channels;
        glm::dvec3 squares(0);
        for (size_t i = 0; i < count; i++) {
            const float* pixel = &image.pixels[i * image.channels];
            const glm::dvec3 value(pixel[0], pixel[1], pixel[2]);
            mean += value / double(count);
            squares += value * value / double(count);
        }
        error = glm::sqrt(glm::max(squares - mean * mean, 0.0) / double(count));
    }
};

inline Seen seen(const Scene& scene, uint32_t samples, uint32_t depth, uint32_t size = 16) {
    RenderOptions options = small_options(size, size, samples);
    options.depth = depth;
    return Seen(render_scene(scene, options).image);
}

inline void check_near(const glm::dvec3& got, const glm::dvec3& wanted, double margin) {
    INFO(got.x << " " << got.y << " " << got.z << ", wanted " << wanted.x << " " << wanted.y << " "
               << wanted.z);
    CHECK(glm::length(got - wanted) < margin);
}

inline void check_white(const Seen& all) {
    for (glm::length_t c = 0; c < 3; c++) {
        INFO("channel " << c << ": " << all.mean[c] << " within " << all.error[c]);
        CHECK(all.error[c] < 0.01);
        CHECK(std::abs(all.mean[c] - 1) < 2e-4 + 4 * all.error[c]);
    }
}

inline double phase(double cosine, double g) {
    return (1 - g * g) / (4 * M_PI * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// A slab from z = 0 to -depth, seen by parallel rays along -z.
inline Scene slab(const Medium& medium, float depth) {
    Scene scene;
    scene.materials = {boundary(medium)};
    scene.meshes = {box_mesh(glm::vec3(3, 3, depth), 0)};
    scene.instances = {{0, glm::translate(glm::mat4(1.0f), glm::vec3(0, 0, -0.5f * depth))}};
    scene.cameras = {camera_at({0, 0, 5}, {0, 0, 0}, 0.1f)};
    scene.cameras[0].orthographic_height = 1.0f;
    return scene;
}

} // namespace onde::test
