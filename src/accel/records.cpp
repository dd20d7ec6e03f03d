#include "accel/records.h"

#include <cmath>

namespace onde::accel {

namespace {

void store_rows(const glm::mat4& matrix, float (&rows)[12]) {
    for (glm::length_t row = 0; row < 3; ++row)
        for (glm::length_t column = 0; column < 4; ++column)
            rows[4 * row + column] = matrix[column][row];
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
    const glm::mat3 linear(placement.object_to_world);
    instance.scale = std::sqrt(glm::dot(linear[0], linear[0]) + glm::dot(linear[1], linear[1]) +
                               glm::dot(linear[2], linear[2]));
    return instance;
}

} // namespace onde::accel
