// Triangles cut in two by planes across an axis: what builders with spatial splits put on each
// side.
//
// Why the hits stay the same bits when several leaves hold a triangle: every part's box
// contains what the kernels may take for a hit on that part, as the box of a whole triangle does.
// So a ray enters the box of the part that it hits no later than the hit. A leaf with another part
// of the triangle finds the same hit, and as it counts as no closer than where the ray enters that
// leaf's box, it is farther, or the same. The smallest is what remains, in whatever order leaves
// are visited; and a leaf whose box is entered before the smallest is never skipped.
#pragma once

#include "accel/reference.h"

namespace onde::accel {

struct Corners {
    Lanes at[3];
};

/// Of a reference that is a triangle's.
inline Corners corners_of(std::span<const Geometry> geometries, const Reference& reference) {
    const Geometry& geometry = geometries[reference.owner()];
    const glm::uvec3 corners = geometry.triangles[reference.index()];
    return {{lanes(geometry.positions[corners.x]), lanes(geometry.positions[corners.y]),
             lanes(geometry.positions[corners.z])}};
}

/// The parts of a box below and above a plane; those without points are empty.
struct Halves {
    Box below, above;
};

/// What a triangle covers on both sides of the plane at `at` across `axis`, within `bounds`. Exact
/// but for rounding.
inline Halves halve(const Corners& corners, const Box& bounds, int axis, float at) {
    Halves halves;
    for (int i = 0; i < 3; ++i) {
        const Lanes a = corners.at[i], b = corners.at[i == 2 ? 0 : i + 1];
        const float from = a[axis], to = b[axis];
        if (from <= at) halves.below.extend(a);
        if (from >= at) halves.above.extend(a);
        if ((from < at && to > at) || (from > at && to < at)) {
            const Lanes crossing = a + (b - a) * splat((at - from) / (to - from));
            halves.below.extend(crossing);
            halves.above.extend(crossing);
        }
    }
    return {halves.below.common(bounds), halves.above.common(bounds)};
}

/// Enlarges the boxes of triangles by the margin that a part's box needs: 2^-21 of the triangle's
/// largest coordinate, which may lie far outside of the part.
void add_margins(std::span<Reference> references, bool parallel);

/// The references to a triangle's parts below and above a plane, with that margin, from one that
/// has it. A part may be nothing: its box then has no points.
Halves cut(std::span<const Geometry> geometries, const Reference& reference, int axis, float at);

} // namespace onde::accel
