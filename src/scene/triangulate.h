// Polygons of mesh files into triangles.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace onde {

/// Corners as indices into a list of positions, in range; there are fewer than 2^32.
struct Polygon {
    std::span<const glm::dvec3> positions;
    std::span<const uint32_t> corners;

    size_t size() const { return corners.size(); }
    const glm::dvec3& operator[](size_t corner) const { return positions[corners[corner]]; }
};

/// Triangles, as numbers of corners, of a polygon without holes that lies about in a plane: a fan
/// where it is convex, ears clipped where it is not (Meisters, "Polygons have ears", 1975). It
/// makes `size() - 2` triangles that keep the winding, also where the polygon crosses itself. Each
/// ear is tested against a hierarchy of the corners, so n corners take about n log n in most
/// polygons; what would take much more is cut into a fan from there on.
std::vector<std::array<uint32_t, 3>> triangulate(const Polygon& polygon);

} // namespace onde
