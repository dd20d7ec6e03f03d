#include "accel/cut.h"

#include "accel/parallel.h"

#include <algorithm>
#include <cmath>

namespace onde::accel {

namespace {

float margin_of(const Box& box) {
    const Lanes reach = upper(box.high, -box.low); // one of them is the largest, as low <= high
    return std::ldexp(std::max({float(reach[0]), float(reach[1]), float(reach[2])}), -21);
}

} // namespace

void add_margins(std::span<Reference> references, bool parallel) {
    for_each_index(references.size(), parallel, [&](size_t i) {
        Reference& reference = references[i];
        if (reference.is_single()) return;
        const Box box = reference.box();
        reference = {box.widened(margin_of(box)), reference.owner(), reference.index()};
    });
}

Halves cut(std::span<const Geometry> geometries, const Reference& reference, int axis, float at) {
    const Corners corners = corners_of(geometries, reference);
    Box whole;
    for (const Lanes& corner : corners.at) whole.extend(corner);
    // Crossings are rounded by less than twice the margin that is due.
    const float margin = 3.0f * margin_of(whole);
    const Box everything = {splat(-std::numeric_limits<float>::max()),
                            splat(std::numeric_limits<float>::max())};
    const Halves halves = halve(corners, everything, axis, at);
    const Box bounds = reference.box();
    return {halves.below.widened(margin).common(bounds),
            halves.above.widened(margin).common(bounds)};
}

} // namespace onde::accel
