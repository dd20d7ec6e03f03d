// The median split with spatial cuts: triangles that straddle the plane are cut in two.
#include "accel/plain.h"

#include "accel/plain_builder.h"
#include "accel/split.h"

#include <cmath>

namespace onde::accel {

namespace {

/// A triangle after up to six cuts; convex.
struct Polygon {
    glm::dvec3 corner[12];
    int count = 0;

    void add(glm::dvec3 p) { corner[count++] = p; }
};

/// The part with sign * p[axis] <= sign * at.
Polygon kept(const Polygon& polygon, int axis, double at, double sign) {
    Polygon part;
    for (int i = 0; i < polygon.count; ++i) {
        const glm::dvec3 a = polygon.corner[i], b = polygon.corner[(i + 1) % polygon.count];
        const double past_a = sign * (a[size_t(axis)] - at), past_b = sign * (b[size_t(axis)] - at);
        if (past_a <= 0) part.add(a);
        if ((past_a < 0 && past_b > 0) || (past_a > 0 && past_b < 0))
            part.add(a + (b - a) * (past_a / (past_a - past_b)));
    }
    return part;
}

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
            const Box low = part_box(references[i], axis, at, 1.0);
            const Box high = part_box(references[i], axis, at, -1.0);
            const uint32_t owner = references[i].owner(), index = references[i].index();
            if (!low.is_empty()) left.emplace_back(low, owner, index);
            if (!high.is_empty() || low.is_empty())
                right.emplace_back(high.is_empty() ? box : high, owner, index);
        }
        const size_t all = left.size() + right.size(), before = references.size();
        if (all <= before + budget && left.size() < before && right.size() < before &&
            !left.empty() && !right.empty())
            return true;
        left.clear();
        right.clear();
        return false;
    }

    /// The box of what remains of a triangle within its reference's box and one side of the plane.
    Box part_box(const Reference& reference, int axis, float at, double sign) const {
        const Geometry& geometry = geometries_[reference.owner()];
        const glm::uvec3 corners = geometry.triangles[reference.index()];
        const Box box = reference.box();
        Polygon polygon;
        for (size_t k = 0; k < 3; ++k) polygon.add(glm::dvec3(geometry.positions[corners[k]]));
        // A little outside, so that rounding never loses a part that is flat.
        constexpr double SLACK = 1e-6;
        for (int k = 0; k < 3; ++k) {
            polygon = kept(polygon, k, box.high[k] + SLACK * std::abs(box.high[k]), 1.0);
            polygon = kept(polygon, k, box.low[k] - SLACK * std::abs(box.low[k]), -1.0);
        }
        polygon = kept(polygon, axis, at + sign * SLACK * std::abs(at), sign);
        Box part;
        for (int i = 0; i < polygon.count; ++i) {
            const glm::dvec3 p = polygon.corner[i];
            part.extend(lower(upper(lanes(glm::vec3(p)), box.low), box.high));
        }
        return part;
    }

    std::span<const Geometry> geometries_;
    PlainBuilder builder_;
};

} // namespace

BinaryTree build_median_spatial(std::vector<Reference> references,
                                std::span<const Geometry> geometries) {
    if (references.empty()) return {};
    return SpatialBuilder(geometries).build(std::move(references));
}

} // namespace onde::accel
