// What a tree is built over: the box of a primitive or of an instance, and where it came from.
#pragma once

#include "accel/box.h"
#include "accel/bvh.h"

#include <bit>
#include <span>
#include <vector>

namespace onde::accel {

/// Where a reference came from: what is left of it once the tree is split. With the SINGLE bit it
/// needs a leaf of its own; triangles share leaf blocks.
struct Origin {
    static constexpr uint32_t SINGLE = 0x80000000u;
    static constexpr uint32_t INSTANCE = 0xffffffffu; ///< as owner: `index` is a placement

    uint32_t owner; ///< the geometry, with SINGLE for its spheres and shapes; or INSTANCE
    uint32_t index; ///< within the geometry: triangles first, then spheres, then shapes

    bool is_single() const { return owner & SINGLE; }
};

/// 32 bytes, partitioned in place by the builder.
struct Reference {
    static constexpr uint32_t SINGLE = Origin::SINGLE, INSTANCE = Origin::INSTANCE;

    Lanes low_owner;  ///< low corner; the fourth lane holds the owner's bits
    Lanes high_index; ///< high corner; the fourth lane holds the index's bits

    Reference() = default;
    Reference(const Box& box, uint32_t owner, uint32_t index)
        : low_owner(box.low), high_index(box.high) {
        low_owner[3] = std::bit_cast<float>(owner);
        high_index[3] = std::bit_cast<float>(index);
    }

    /// As those of Origin.
    uint32_t owner() const { return std::bit_cast<uint32_t>(float(low_owner[3])); }
    uint32_t index() const { return std::bit_cast<uint32_t>(float(high_index[3])); }
    Origin origin() const { return {owner(), index()}; }
    bool is_single() const { return owner() & SINGLE; }

    Box box() const {
        // The fourth lanes may look like denormals or NaN, which arithmetic must not meet.
        const IntLanes keep = {-1, -1, -1, 0};
        return {Lanes(IntLanes(low_owner) & keep), Lanes(IntLanes(high_index) & keep)};
    }
};
static_assert(sizeof(Reference) == 32);

/// Exact bounds of a triangle's corners, or of a sphere.
Box triangle_box(const Geometry& geometry, uint32_t triangle);
Box sphere_box(const SphereInput& sphere);
Box shape_box(const ShapeInput& shape);
/// Of the sphere or shape with that index.
Box single_box(const Geometry& geometry, uint32_t index);

/// The references of every primitive of the geometries named by `owners`, in order.
std::vector<Reference> make_references(std::span<const Geometry> geometries,
                                       std::span<const uint32_t> owners, bool parallel);

} // namespace onde::accel
