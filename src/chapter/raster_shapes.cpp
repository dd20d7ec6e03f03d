#include "chapter/raster_shapes.h"

#include <cmath>
#include <numbers>

namespace onde {
namespace {

/// The point of a closed curve in the plane of radius and height: (distance from the Y axis, y).
using Profile = std::vector<glm::dvec2>;

glm::dvec2 on_circle(double turn) {
    const double angle = 2 * std::numbers::pi * turn;
    return {std::cos(angle), std::sin(angle)};
}

/// An arc around (center, 0), from `first` to `last` turns.
Profile arc(double center, double radius, double first, double last, uint32_t segments) {
    Profile profile;
    for (uint32_t i = 0; i <= segments; i++)
        profile.push_back(glm::dvec2(center, 0) +
                          radius * on_circle(first + (last - first) * i / segments));
    return profile;
}

Profile profile_of(const Shape& shape) {
    switch (shape.kind) {
    case ShapeKind::sphere:
        return arc(0, 1, -0.25, 0.25, SHAPE_SEGMENTS / 2);
    case ShapeKind::disk:
        return {{1, 0}, {0, 0}};
    case ShapeKind::cylinder:
        return {{0, -1}, {1, -1}, {1, 1}, {0, 1}};
    case ShapeKind::cone:
        return {{0, 0}, {1, 0}, {0, 1}};
    case ShapeKind::torus:
        return arc(1, shape.minor_radius, 0, 1, SHAPE_SEGMENTS / 2);
    }
    return {};
}

void add_triangle(Mesh& mesh, uint32_t a, uint32_t b, uint32_t c, uint32_t material) {
    mesh.triangles.push_back({a, b, c});
    mesh.materials.push_back(material);
}

} // namespace

Mesh shape_mesh(const Shape& shape) {
    Mesh mesh;
    const Profile profile = profile_of(shape);
    const auto rows = uint32_t(profile.size());
    for (const glm::dvec2& point : profile)
        for (uint32_t i = 0; i < SHAPE_SEGMENTS; i++) {
            const glm::dvec2 around = point.x * on_circle(double(i) / SHAPE_SEGMENTS);
            mesh.positions.push_back(glm::vec3(around.x, point.y, -around.y));
        }
    constexpr double ON_AXIS = 1e-12; // where a ring is a point, one of its triangles is none
    for (uint32_t row = 0; row + 1 < rows; row++)
        for (uint32_t i = 0; i < SHAPE_SEGMENTS; i++) {
            const uint32_t next = (i + 1) % SHAPE_SEGMENTS;
            const uint32_t a = row * SHAPE_SEGMENTS, b = a + SHAPE_SEGMENTS;
            if (profile[row].x > ON_AXIS)
                add_triangle(mesh, a + i, a + next, b + next, shape.material);
            if (profile[row + 1].x > ON_AXIS)
                add_triangle(mesh, a + i, b + next, b + i, shape.material);
        }
    return mesh;
}

} // namespace onde
