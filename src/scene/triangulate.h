// Polygons of mesh files into triangles.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace onde {

/// Triangles, as indices into `corners`, of a polygon without holes that lies about in a plane: a
/// fan where it is convex, ears clipped where it is not (Meisters, "Polygons have ears", 1975).
/// `corners.size() - 2` triangles that keep its winding, also where it crosses itself. Each ear is
/// tested against a hierarchy of the corners, so n corners take about n sqrt(n) at worst, and n
/// log n in most polygons. There are fewer than 2^32.
std::vector<std::array<uint32_t, 3>> triangulate(std::span<const glm::dvec3> corners);

} // namespace onde
