// Triangles and spheres in bulk, for checks and tests of trees and of traversal.
#pragma once

#include "accel/bvh.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <random>

namespace onde::doctor {

/// Owns what a Geometry only points to.
struct Soup {
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;
    std::vector<SphereInput> spheres;
    uint32_t first_primitive = 0;
    std::vector<ShapeInput> shapes;

    Geometry geometry() const { return {positions, triangles, spheres, first_primitive, shapes}; }
    uint32_t size() const { return uint32_t(triangles.size() + spheres.size() + shapes.size()); }

    void add(glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const auto first = uint32_t(positions.size());
        positions.insert(positions.end(), {a, b, c});
        triangles.emplace_back(first, first + 1, first + 2);
    }
};

using Generator = std::mt19937;

inline float uniform(Generator& generator, float low = 0.0f, float high = 1.0f) {
    return low + (high - low) * float(generator() >> 8) * 0x1p-24f;
}
inline glm::vec3 uniform_point(Generator& generator, float low = -1.0f, float high = 1.0f) {
    const float x = uniform(generator, low, high), y = uniform(generator, low, high);
    return {x, y, uniform(generator, low, high)};
}

/// Triangles of edge about `size` in the cube [-scale, scale]^3 around `center`.
inline Soup random_triangles(uint32_t count, float size, unsigned seed, float scale = 1.0f,
                             glm::vec3 center = glm::vec3(0.0f)) {
    Generator generator(seed);
    Soup soup;
    for (uint32_t i = 0; i < count; ++i) {
        const glm::vec3 corner = center + scale * uniform_point(generator);
        const glm::vec3 e1 = size * uniform_point(generator), e2 = size * uniform_point(generator);
        soup.add(corner, corner + e1, corner + e2);
    }
    return soup;
}

inline Soup random_spheres(uint32_t count, float radius, unsigned seed) {
    Generator generator(seed);
    Soup soup;
    for (uint32_t i = 0; i < count; ++i)
        soup.spheres.push_back({uniform_point(generator), uniform(generator, 0.2f, 1.0f) * radius});
    return soup;
}

/// A height field of 2 cells^2 triangles over [-1, 1]^2 with shared corners, Y up.
inline Soup bumpy_terrain(uint32_t cells) {
    Soup soup;
    for (uint32_t row = 0; row <= cells; ++row)
        for (uint32_t column = 0; column <= cells; ++column) {
            const float x = 2.0f * float(column) / float(cells) - 1.0f;
            const float z = 2.0f * float(row) / float(cells) - 1.0f;
            const float y = 0.15f * std::sin(5 * x) * std::cos(4 * z) +
                            0.03f * std::sin(31 * x + 7 * z) +
                            0.008f * std::cos(97 * x * z + 50 * z);
            soup.positions.emplace_back(x, y, z);
        }
    for (uint32_t row = 0; row < cells; ++row)
        for (uint32_t column = 0; column < cells; ++column) {
            const uint32_t a = row * (cells + 1) + column, b = a + cells + 1;
            soup.triangles.emplace_back(a, b, a + 1);
            soup.triangles.emplace_back(a + 1, b, b + 1);
        }
    return soup;
}

/// A rotation, an uneven scale between 0.3 and 1.2 and a shift of up to `spread` along each axis.
inline glm::mat4 random_transform(Generator& generator, float spread) {
    const glm::mat4 shift =
        glm::translate(glm::mat4(1.0f), uniform_point(generator, -spread, spread));
    const glm::vec3 axis = uniform_point(generator) + glm::vec3(0.0f, 0.0f, 1.5f);
    const glm::mat4 turn = glm::rotate(shift, uniform(generator, 0.0f, 6.0f), glm::normalize(axis));
    return glm::scale(turn, uniform_point(generator, 0.3f, 1.2f));
}

} // namespace onde::doctor
