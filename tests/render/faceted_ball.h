// A ball of few triangles.
#pragma once

#include "scene/scene.h"

#include <cmath>

namespace onde::test {

/// A sphere of flat triangles, whose rows at the poles are narrow ones.
inline Mesh faceted_ball(uint32_t columns, uint32_t rows) {
    Mesh mesh;
    const double pi = std::acos(-1.0);
    for (uint32_t j = 0; j <= rows; j++)
        for (uint32_t i = 0; i < columns; i++) {
            const double up = pi * j / rows, around = 2 * pi * i / columns;
            mesh.positions.emplace_back(std::sin(up) * std::cos(around), std::cos(up),
                                        std::sin(up) * std::sin(around));
        }
    for (uint32_t j = 0; j < rows; j++)
        for (uint32_t i = 0; i < columns; i++) {
            const uint32_t a = j * columns + i, b = j * columns + (i + 1) % columns;
            mesh.triangles.emplace_back(a, b, a + columns);
            mesh.triangles.emplace_back(b, b + columns, a + columns);
        }
    mesh.materials.assign(mesh.triangles.size(), 0);
    return mesh;
}

} // namespace onde::test
