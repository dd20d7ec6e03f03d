// Where to cut a set of references in two: the binned surface-area heuristic.
#pragma once

#include "accel/reference.h"

#include <span>

namespace onde::accel {

inline constexpr uint32_t MAX_BINS = 32;

/// The bounds that a node's split is searched in.
struct Extent {
    Box box;     ///< of the references
    Box centers; ///< of the centres of their boxes

    void extend(const Box& reference) {
        box.extend(reference);
        centers.extend(reference.center());
    }
    void merge(const Extent& other) {
        box.extend(other.box);
        centers.extend(other.centers);
    }
};

/// Maps box centres to bins, along the three axes at once.
class BinGrid {
  public:
    BinGrid(const Box& centers, uint32_t bins);

    uint32_t bins() const { return bins_; }
    IntLanes bin(Lanes center) const {
        return __builtin_convertvector((center - origin_) * scale_, IntLanes);
    }

  private:
    uint32_t bins_;
    Lanes origin_, scale_;
};

/// A cut: references whose bin along `axis` is below `bin` go left. axis < 0: no cut separates
/// them.
struct Split {
    int axis = -1;
    uint32_t bin = 0;
    float cost = std::numeric_limits<float>::infinity(); ///< in half areas times split_weight()
    Box sides[2];
};

/// What a subtree over so many references is expected to cost a ray that meets its box, in eighths
/// of a leaf block. Blocks that are not full cost as much as full ones, so that sizes just above a
/// multiple of eight don't pay; but higher up few are full. The mixture gave trees of less cost
/// than either, and 15 % smaller ones than the count alone.
inline float split_weight(uint32_t count) {
    const uint32_t rounded = (count + BVH_LEAF_WIDTH - 1) / BVH_LEAF_WIDTH * BVH_LEAF_WIDTH;
    return 0.75f * float(rounded) + 0.25f * float(count) + 3.0f;
}

/// The cut of least area(left) weight(left) + area(right) weight(right) over all axes and bin
/// borders; among equals the most even one (Wald, "On fast construction of SAH-based bounding
/// volume hierarchies", 2007).
Split find_split(std::span<const Reference> references, const BinGrid& grid, bool parallel);

/// Moves the left side to the front; returns its size. `sides` receives the extents of both.
uint32_t partition(std::span<Reference> references, const BinGrid& grid, const Split& split,
                   Extent (&sides)[2]);

/// For references that no cut separates: halves them by centre along the longest axis, then by
/// origin.
uint32_t partition_evenly(std::span<Reference> references, Extent (&sides)[2]);

} // namespace onde::accel
