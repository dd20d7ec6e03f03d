#include "accel/records.h"

#include "accel/wide.h"

#include <algorithm>
#include <cmath>

namespace onde::accel {

namespace {

void store_rows(const glm::mat4& matrix, float (&rows)[12]) {
    for (glm::length_t row = 0; row < 3; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            rows[4 * row + column] = matrix[column][row];
}

/// By which a length grows at most.
float largest_scale(const glm::mat4& matrix) {
    const glm::mat3 linear(matrix);
    return std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) +
                     glm::dot(linear[2], linear[2]));
}

} // namespace

void set_slot(BvhNode& node, uint32_t slot, const Box& box, uint32_t word) {
    node.low_x[slot] = box.low[0], node.high_x[slot] = box.high[0];
    node.low_y[slot] = box.low[1], node.high_y[slot] = box.high[1];
    node.low_z[slot] = box.low[2], node.high_z[slot] = box.high[2];
    node.child[slot] = word;
}

void set_triangle(TriangleBlock& block, uint32_t lane, const Geometry& geometry, uint32_t index,
                  bool watertight) {
    const glm::uvec3 corners = geometry.triangles[index];
    const glm::vec3 v0 = geometry.positions[corners.x];
    const glm::vec3 from = watertight ? glm::vec3(0.0f) : v0;
    const glm::vec3 e1 = geometry.positions[corners.y] - from;
    const glm::vec3 e2 = geometry.positions[corners.z] - from;
    block.v0_x[lane] = v0.x, block.v0_y[lane] = v0.y, block.v0_z[lane] = v0.z;
    block.e1_x[lane] = e1.x, block.e1_y[lane] = e1.y, block.e1_z[lane] = e1.z;
    block.e2_x[lane] = e2.x, block.e2_y[lane] = e2.y, block.e2_z[lane] = e2.z;
    block.primitive[lane] = geometry.first_primitive + index;
}

BvhInstance make_instance(const Placement& placement, uint32_t root) {
    BvhInstance instance{};
    store_rows(placement.object_to_world, instance.object_to_world);
    // In double precision: the inverse carries every ray into object space.
    store_rows(glm::mat4(glm::inverse(glm::dmat4(placement.object_to_world))),
               instance.world_to_object);
    instance.root = root;
    instance.scale = largest_scale(placement.object_to_world);
    for (const glm::mat4& key : placement.keys)
        instance.scale = std::max(instance.scale, largest_scale(key));
    instance.steps = placement.keys.empty() ? 0 : uint32_t(placement.keys.size() - 1);
    return instance;
}

void put_keys(const Placement& placement, AlignedVector<BvhInstance>& instances, size_t index) {
    if (placement.keys.empty()) return;
    instances[index].keys = uint32_t(instances.size());
    for (const glm::mat4& key : placement.keys) {
        BvhInstance& record = instances.emplace_back();
        store_rows(key, record.object_to_world);
        record.root = BVH_NONE;
    }
}

void put_instances(std::span<const Placement> placements, std::span<const uint32_t> roots,
                   AlignedVector<BvhInstance>& instances) {
    instances.clear();
    for (const Placement& placement : placements)
        instances.push_back(make_instance(placement, roots[placement.geometry]));
    for (size_t i = 0; i < placements.size(); ++i) put_keys(placements[i], instances, i);
}

} // namespace onde::accel

namespace onde {

uint32_t add_mover(Bvh& bvh, std::span<const glm::mat4> keys) {
    const auto index = uint32_t(bvh.instances.size());
    const Placement placement{.geometry = 0, .object_to_world = keys[0], .keys = keys};
    bvh.instances.push_back(accel::make_instance(placement, BVH_NONE));
    accel::put_keys(placement, bvh.instances, index);
    return index;
}

} // namespace onde

namespace onde::accel {

Box placed_box(const Box& box, const Placement& placement) {
    if (placement.keys.empty()) return padded(transformed(padded(box), placement.object_to_world));
    // A point's way is straight between two keys. Their mean is inverted in single precision.
    Box all;
    for (const glm::mat4& key : placement.keys)
        all.extend(padded(padded(transformed(padded(box), key))));
    return padded(padded(all));
}

} // namespace onde::accel
