// How far the curved surface that a triangle stands for rises above it.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace onde {

/// Of a triangle with those corners and unit normals there, as far as the host can say before a
/// point is known: where the planes of the corners lie over the triangle, as Hanika moves origins
/// ("Hacking the Shadow Terminator", Ray Tracing Gems II, 2021). With a point's weights w it is the
/// sum over edges of w_i w_j (p_i - p_j) . (n_i - n_j), positive where the edge is convex as seen
/// from the side of `geometric`. Three such numbers, rounded away from 0: 8 bits each, as 128 plus
/// a number of units; above them the exponent of the unit as floats have it, in the order of edges
/// 0-1, 1-2, 2-0. 0 where there is none. See kernels/shade/bulge.h.
uint32_t encode_bulge(const glm::vec3 (&corners)[3], const glm::vec3 (&normals)[3],
                      glm::vec3 geometric);

} // namespace onde
