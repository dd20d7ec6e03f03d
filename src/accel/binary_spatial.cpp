// The binary tree with spatial splits, in one array: behind a node's references there is room for
// those that splits below it may add, and a node shares out what is left of its room.
#include "accel/binary.h"

#include "accel/parallel.h"
#include "accel/spatial_split.h"

#include <algorithm>
#include <cmath>

namespace onde::accel {

namespace {

/// Stich et al. have a tenth; that took longer and gave trees no better.
constexpr float LEAST_OVERLAP = 1e-4f; // of the root's area

/// A node's references, from `begin` on, and the room behind them.
struct Range {
    uint32_t begin, count, room;
};

class SpatialBinaryBuilder {
  public:
    SpatialBinaryBuilder(BinaryTree& tree, std::span<Reference> references,
                         std::span<const Geometry> geometries, const BvhOptions& options)
        : tree_(tree), references_(references), geometries_(geometries),
          max_bins_(std::clamp(options.bins, 2u, MAX_BINS)),
          leaf_triangles_(shape_of(options.layout).leaf_triangles), parallel_(options.parallel) {}

    void build(uint32_t count) {
        const auto room = uint32_t(references_.size()) - count;
        Extent extent;
        fold_ranges(extent, count, parallel_, [&](Extent& part, size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) part.extend(references_[i].box());
        });
        least_overlap_ = LEAST_OVERLAP * half_area(extent.box);
        tree_.nodes.grow_by(1);
        build_node(0, {0, count, room}, extent);
    }

  private:
    void build_node(uint32_t node, const Range& range, const Extent& extent) {
        const auto references = references_.subspan(range.begin, range.count);
        if (fits_leaf(references)) {
            tree_.nodes[node] = {extent.box.low, extent.box.high, 0, range.begin, range.count, 0};
            return;
        }
        const SpatialSides sides = divide(range, extent);
        Range parts[2];
        share_out(range, sides, parts);
        const uint32_t child = tree_.add_children();
        tree_.nodes[node] = {extent.box.low, extent.box.high, child, range.begin, range.count, 0};
        run_both(
            parallel_ && range.count > TASK_SIZE,
            [&] { build_node(child, parts[0], sides.extents[0]); },
            [&] { build_node(child + 1, parts[1], sides.extents[1]); });
    }

    bool fits_leaf(std::span<const Reference> references) const {
        if (references.size() == 1) return true;
        return references.size() <= leaf_triangles_ &&
               std::ranges::none_of(references, &Reference::is_single);
    }

    SpatialSides divide(const Range& range, const Extent& extent) {
        const auto references = references_.subspan(range.begin, range.count);
        const uint32_t bins = std::min<uint32_t>(max_bins_, 4 + range.count / 4);
        const BinGrid grid(extent.centers, bins);
        const Split split = find_split(references, grid, parallel_);
        if (may_pay(split, extent) && range.room > 0) {
            const SpatialGrid space(extent.box, std::min(bins, SpatialGrid::MOST_BINS));
            const SpatialSplit cut =
                find_spatial_split(references, geometries_, space, range.room, parallel_);
            if (cut.cost < split.cost) {
                const SpatialSides sides =
                    partition_spatially(references.data(), range.count, geometries_, space, cut);
                if (sides.counts[0] > 0 && sides.counts[1] > 0) return sides;
            }
        }
        SpatialSides sides{};
        sides.counts[0] = split.axis < 0 ? partition_evenly(references, sides.extents)
                                         : partition(references, grid, split, sides.extents);
        sides.counts[1] = range.count - sides.counts[0];
        return sides;
    }

    /// Where the children of the best object split hardly overlap, a spatial split gains nothing
    /// (Stich et al.).
    bool may_pay(const Split& split, const Extent& extent) const {
        const Box overlap = split.axis < 0 ? extent.box : split.sides[0].common(split.sides[1]);
        return overlap.has_points() && half_area(overlap) > least_overlap_;
    }

    /// Gives each side its share of the room, behind its references.
    void share_out(const Range& range, const SpatialSides& sides, Range (&parts)[2]) {
        const uint32_t rest = range.room - (sides.counts[0] + sides.counts[1] - range.count);
        const double weights[2] = {need(sides, 0), need(sides, 1)};
        const double all = weights[0] + weights[1];
        const double share = all > 0 && std::isfinite(all) ? weights[0] / all : 0.5;
        const auto room = uint32_t(double(rest) * share);
        parts[0] = {range.begin, sides.counts[0], room};
        parts[1] = {range.begin + sides.counts[0] + room, sides.counts[1], rest - room};
        // The right side makes way: its first references go behind its last.
        Reference* right = &references_[range.begin + sides.counts[0]];
        const uint32_t moved = std::min(room, sides.counts[1]);
        std::copy_n(right, moved, right + room + sides.counts[1] - moved);
    }

    /// Room goes where rays are expected to spend their time; a leaf needs none.
    double need(const SpatialSides& sides, int side) const {
        if (sides.counts[side] <= leaf_triangles_) return 0;
        return double(sides.counts[side]) * half_area(sides.extents[side].box);
    }

    static constexpr uint32_t TASK_SIZE = 1024;

    BinaryTree& tree_;
    std::span<Reference> references_;
    std::span<const Geometry> geometries_;
    uint32_t max_bins_, leaf_triangles_;
    float least_overlap_ = 0;
    bool parallel_;
};

} // namespace

BinaryTree build_binary_spatial(std::vector<Reference> references,
                                std::span<const Geometry> geometries, const BvhOptions& options) {
    BinaryTree tree;
    const auto count = uint32_t(references.size());
    if (count == 0) return tree;
    add_margins(references, options.parallel);
    const double share = std::clamp(double(options.extra_references), 0.0, 1.0);
    references.resize(count + size_t(share * count));
    SpatialBinaryBuilder(tree, references, geometries, options).build(count);
    tree.keep_origins(references);
    return tree;
}

} // namespace onde::accel
