// A picture of what rays cost: the boxes and primitives that the camera ray of each pixel tests.
#pragma once

#include "image/image.h"
#include "render/integrator.h"

namespace onde {

/// By pixel, row by row from the top; of the ray of sample 0.
struct TraversalCost {
    uint32_t width = 0, height = 0;
    std::vector<uint32_t> boxes, primitives;

    uint32_t at(size_t pixel) const { return boxes[pixel] + primitives[pixel]; }
    uint64_t sum() const;
    uint32_t largest() const;
};

/// The box tests of a wide node are its children; spheres and shapes count like triangles.
TraversalCost measure_traversal_cost(const IntegratorContext& context);

/// The counts themselves: boxes, primitives and their sum in three channels.
Image cost_numbers(const TraversalCost& map);
/// Colours from black over blue, red and yellow to white, which is the largest count.
Image heat_picture(const TraversalCost& map);

} // namespace onde
