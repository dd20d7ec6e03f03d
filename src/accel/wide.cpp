#include "accel/wide.h"

#include "accel/parallel.h"
#include "accel/plain.h"

#include <algorithm>
#include <cmath>

namespace onde::accel {

namespace {

constexpr uint32_t TASK_SIZE = 16384;

BinaryTree split_tree(std::vector<Reference> references, std::span<const Geometry> geometries,
                      const BvhOptions& options) {
    switch (options.builder) {
    case BvhBuilder::median:
        return build_median(std::move(references));
    case BvhBuilder::median_spatial:
        return build_median_spatial(std::move(references), geometries);
    case BvhBuilder::none:
        return build_list(std::move(references), shape_of(options.layout).leaf_triangles);
    case BvhBuilder::high:
        return build_binary_spatial(std::move(references), geometries, options);
    case BvhBuilder::sah:
        break;
    }
    return build_binary(std::move(references), options);
}

} // namespace

WideTree::WideTree(std::vector<Reference> references, std::span<const WideSize> instances,
                   std::span<const Geometry> geometries, const BvhOptions& options)
    : collapse_(split_tree(std::move(references), geometries, options), options),
      parallel_(options.parallel), root_is_node_(shape_of(options.layout).root_is_node),
      sizes_(collapse_.tree().nodes.size()), root_size_(measure_root(instances)) {}

Box WideTree::box() const {
    return collapse_.tree().is_empty() ? Box{} : collapse_.tree().nodes[0].box();
}

WideSize WideTree::measure_root(std::span<const WideSize> instances) {
    const BinaryTree& tree = collapse_.tree();
    if (tree.is_empty()) return {.nodes = 1, .depth = 1};
    if (!tree.nodes[0].is_leaf()) return measure(0, instances);
    WideSize size = measure_leaf(tree.nodes[0], instances);
    size.nodes += root_is_node_;
    size.depth += root_is_node_;
    return size;
}

WideSize WideTree::measure_leaf(const BinaryNode& leaf, std::span<const WideSize> instances) const {
    const Origin origin = collapse_.tree().origins[leaf.begin];
    if (!origin.is_single()) return {.blocks = 1};
    if (origin.owner != Origin::INSTANCE) return {.spheres = 1};
    const WideSize& inside = instances[origin.index];
    // A sentinel waits below everything that the instance's own tree pushes.
    return {.depth = inside.depth, .stack = inside.stack + 1};
}

WideSize WideTree::measure(uint32_t index, std::span<const WideSize> instances) {
    const BinaryTree& tree = collapse_.tree();
    const ChildList children = collapse_.children(index);
    WideSize part[BVH_WIDTH];
    const auto measure_child = [&](size_t i) {
        const BinaryNode& child = tree.nodes[children.node[i]];
        part[i] =
            child.is_leaf() ? measure_leaf(child, instances) : measure(children.node[i], instances);
    };
    for_each_child(children.count, parallel_ && tree.nodes[index].count > TASK_SIZE, measure_child);

    WideSize size{.nodes = 1};
    for (uint32_t i = 0; i < children.count; ++i) {
        size.nodes += part[i].nodes;
        size.blocks += part[i].blocks;
        size.spheres += part[i].spheres;
        size.depth = std::max(size.depth, part[i].depth);
        size.stack = std::max(size.stack, part[i].stack);
    }
    size.depth += 1;
    size.stack += children.count - 1; // the other children wait while one is visited
    return sizes_[index] = size;
}

BvhNode empty_node() {
    BvhNode node{};
    constexpr float INFINITE = std::numeric_limits<float>::infinity();
    for (float* low : {node.low_x, node.low_y, node.low_z}) std::fill_n(low, BVH_WIDTH, INFINITE);
    for (float* high : {node.high_x, node.high_y, node.high_z})
        std::fill_n(high, BVH_WIDTH, -INFINITE);
    std::fill_n(node.child, BVH_WIDTH, BVH_NONE);
    return node;
}

Box padded(const Box& box) {
    float largest = 0.0f;
    for (int axis = 0; axis < 3; ++axis)
        largest = std::max({largest, std::abs(box.low[axis]), std::abs(box.high[axis])});
    const Lanes margin = splat(std::ldexp(largest, -21));
    return {box.low - margin, box.high + margin};
}

Box transformed(const Box& box, const glm::mat4& transform) {
    Box result;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec4 point(corner & 1 ? box.high[0] : box.low[0],
                              corner & 2 ? box.high[1] : box.low[1],
                              corner & 4 ? box.high[2] : box.low[2], 1.0f);
        result.extend(lanes(glm::vec3(transform * point)));
    }
    return result;
}

} // namespace onde::accel
