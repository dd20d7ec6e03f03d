// Worlds to trace rays in, and rays.
#pragma once

#include "doctor/traversal_rig.h"

namespace onde::doctor::traversal {

inline std::vector<Ray> random_rays(size_t count, unsigned seed, float spread = 2.0f) {
    Generator generator(seed);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        ray.origin = uniform_point(generator, -spread, spread);
        ray.direction = uniform_point(generator, -1.0f, 1.0f) - 0.4f * ray.origin;
    }
    return rays;
}

/// A pinhole's rays through a square of pixels, tile by tile, so that packets are coherent.
inline std::vector<Ray> pinhole_rays(uint32_t side, glm::vec3 eye, glm::vec3 target, float spread) {
    const glm::vec3 forward = glm::normalize(target - eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0.1f, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    std::vector<Ray> rays;
    for (uint32_t i = 0; i < side * side; ++i) {
        const uint32_t tile = i / 16, column = 4 * (tile % (side / 4)) + i % 4;
        const uint32_t row = 4 * (tile / (side / 4)) + i / 4 % 4;
        const float x = (float(column) + 0.5f) / float(side) - 0.5f;
        const float y = (float(row) + 0.5f) / float(side) - 0.5f;
        rays.push_back({eye, 0.0f, forward + spread * (x * right + y * up), 1e30f});
    }
    return rays;
}

inline std::vector<Ray> join(std::vector<Ray> a, const std::vector<Ray>& b) {
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

/// Those through side x side pixels, and nearly as many at random.
inline std::vector<Ray> varied_rays(uint32_t side = 256) {
    return join(pinhole_rays(side, {1.2f, 0.9f, 1.5f}, {0, 0, 0}, 1.2f),
                random_rays(side * side * 9 / 10, 41));
}

inline World grove(const BvhOptions& options = {}) {
    Generator generator(17);
    std::vector<Placement> placements = {{0, glm::mat4(1.0f)}};
    for (uint32_t i = 0; i < 20; ++i)
        placements.push_back({1 + i % 2, random_transform(generator, 2.0f)});
    Soup mixed = random_triangles(60, 0.6f, 31);
    mixed.spheres = random_spheres(10, 0.3f, 32).spheres;
    return World({random_triangles(100, 0.4f, 30), std::move(mixed), random_triangles(3, 1.0f, 33)},
                 std::move(placements), options);
}

/// Triangles and spheres in one tree.
inline World mixed_world() {
    Soup soup = random_triangles(1500, 0.3f, 41);
    soup.spheres = random_spheres(100, 0.1f, 42).spheres;
    return World(std::move(soup));
}

/// Long thin triangles, crosswise, some far larger than the rest and far from the origin: spatial
/// splits cut most of them many times. And flat ones, in the planes of their boxes.
inline World needles() {
    Soup soup;
    Generator generator(43);
    for (int i = 0; i < 1500; ++i) {
        const float length = i % 10 == 0 ? 30.0f : 2.0f;
        const glm::vec3 middle = uniform_point(generator), d = length * uniform_point(generator);
        soup.add(middle - d, middle + d, middle + d + 0.05f * uniform_point(generator));
    }
    for (int i = 0; i < 200; ++i) {
        const glm::vec3 corner = uniform_point(generator);
        soup.add(corner, corner + glm::vec3(0.2f, 0, 0), corner + glm::vec3(0, 0, 0.2f));
    }
    return World(std::move(soup));
}

} // namespace onde::doctor::traversal
