// The median split with spatial cuts: triangles that straddle the plane are cut in two.
#include "accel/plain.h"

#include "accel/cut.h"
#include "accel/plain_builder.h"
#include "accel/split.h"

namespace onde::accel {

namespace {

class SpatialBuilder {
  public:
    explicit SpatialBuilder(std::span<const Geometry> geometries) : geometries_(geometries) {}

    BinaryTree build(std::vector<Reference> references) {
        const auto budget = uint32_t(references.size());
        build_node(0, std::move(references), budget);
        return builder_.take();
    }

  private:
    /// A subtree may add `budget` references.
    void build_node(uint32_t node, std::vector<Reference> references, uint32_t budget) {
        Extent extent;
        for (const Reference& reference : references) extent.extend(reference.box());
        if (references.size() == 1) return builder_.set_leaf(node, references, extent.box);

        Extent sides[2];
        const uint32_t half = partition_evenly(references, sides);
        std::vector<Reference> left, right;
        const bool cut = cut_in_two(references, extent, half, budget, left, right);
        if (!cut) {
            left.assign(references.begin(), references.begin() + half);
            right.assign(references.begin() + half, references.end());
        }
        const uint32_t child = builder_.set_inner(node, uint32_t(references.size()), extent.box);
        const auto all = uint32_t(left.size() + right.size());
        const uint32_t rest = budget - (all - uint32_t(references.size()));
        const auto share = uint32_t(uint64_t(rest) * left.size() / all);
        references = {};
        build_node(child, std::move(left), share);
        build_node(child + 1, std::move(right), rest - share);
    }

    /// Whether the cut pays: within budget, and both sides smaller than the whole.
    bool cut_in_two(std::span<const Reference> references, const Extent& extent, uint32_t half,
                    uint32_t budget, std::vector<Reference>& left,
                    std::vector<Reference>& right) const {
        const Lanes size = extent.centers.high - extent.centers.low;
        const int axis =
            size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);
        const float at = references[half].box().center()[axis];
        for (uint32_t i = 0; i < references.size(); ++i) {
            const Box box = references[i].box();
            const bool straddles = box.low[axis] < at && box.high[axis] > at;
            if (!straddles || references[i].is_single()) {
                (i < half ? left : right).push_back(references[i]);
                continue;
            }
            const Halves halves = cut(geometries_, references[i], axis, at);
            const uint32_t owner = references[i].owner(), index = references[i].index();
            const bool below = halves.below.has_points(), above = halves.above.has_points();
            if (below) left.emplace_back(halves.below, owner, index);
            if (above || !below) right.emplace_back(above ? halves.above : box, owner, index);
        }
        const size_t all = left.size() + right.size(), before = references.size();
        if (all <= before + budget && left.size() < before && right.size() < before &&
            !left.empty() && !right.empty())
            return true;
        left.clear();
        right.clear();
        return false;
    }

    std::span<const Geometry> geometries_;
    PlainBuilder builder_;
};

} // namespace

BinaryTree build_median_spatial(std::vector<Reference> references,
                                std::span<const Geometry> geometries) {
    if (references.empty()) return {};
    add_margins(references, false);
    return SpatialBuilder(geometries).build(std::move(references));
}

} // namespace onde::accel
