// Where to cut space in two, and the triangles that lie across with it: the spatial splits of
// Stich, Friedrich and Dietrich, "Spatial splits in bounding volume hierarchies", 2009.
#pragma once

#include "accel/cut.h"
#include "accel/split.h"

namespace onde::accel {

/// The border between two of the equal bins that a node's box is divided into, along `axis`.
struct SpatialSplit {
    int axis = -1; ///< none
    uint32_t bin = 0;
    /// As Split's, with a price on the share of the room that the cuts take.
    float cost = std::numeric_limits<float>::infinity();
    uint32_t counts[2] = {0, 0}; ///< when all that straddle are cut
    Box sides[2];
};

/// Equal bins along each axis of a box. Spheres and all else that is never cut count for the bin of
/// their centre.
class SpatialGrid {
  public:
    static constexpr uint32_t MOST_BINS = 16;

    /// `bins` is at most MOST_BINS.
    SpatialGrid(const Box& box, uint32_t bins);

    uint32_t bins() const { return bins_; }

    /// The lower border of a bin.
    float plane(int axis, uint32_t bin) const { return origin_[axis] + float(bin) * size_[axis]; }

    struct Range {
        IntLanes first, last;
    };
    Range range(const Reference& reference) const {
        const Box box = reference.box();
        if (!reference.is_single()) return {bin(box.low), bin(box.high)};
        const IntLanes at = bin(box.center());
        return {at, at};
    }

  private:
    IntLanes bin(Lanes point) const {
        const Lanes at = (point - origin_) * scale_;
        return __builtin_convertvector(lower(upper(at, splat(0.0f)), splat(float(bins_ - 1))),
                                       IntLanes);
    }

    uint32_t bins_;
    Lanes origin_, size_, scale_;
};

/// The split of least cost that cuts no more than `most_cuts` references.
SpatialSplit find_spatial_split(std::span<const Reference> references,
                                std::span<const Geometry> geometries, const SpatialGrid& grid,
                                uint32_t most_cuts, bool parallel);

/// Two adjacent ranges of references.
struct SpatialSides {
    uint32_t counts[2];
    Extent extents[2];
};

/// Moves the left side to the front of the `count` references at `first`, behind which there is
/// room for as many parts as the split cuts. A reference that costs less when it goes to one side
/// as a whole stays whole (reference unsplitting).
SpatialSides partition_spatially(Reference* first, uint32_t count,
                                 std::span<const Geometry> geometries, const SpatialGrid& grid,
                                 const SpatialSplit& split);

} // namespace onde::accel
