#include "scene/point_hierarchy.h"

#include <algorithm>
#include <numeric>

namespace onde {

namespace {

constexpr size_t LEAF = 8; ///< points of a node that are tested one by one

/// Whether the box lies outside of one of the triangle's edges, or holds nothing but a corner.
bool misses(const std::array<glm::dvec2, 3>& triangle, const glm::dvec2& low,
            const glm::dvec2& high) {
    for (size_t i = 0; i < 3; ++i) {
        const glm::dvec2 &a = triangle[i], &b = triangle[(i + 1) % 3];
        const glm::dvec2 inward(a.y - b.y, b.x - a.x);
        // The corner of the box that lies farthest inward of this edge.
        const glm::dvec2 far(inward.x > 0.0 ? high.x : low.x, inward.y > 0.0 ? high.y : low.y);
        if (turn(a, b, far) < 0.0 || (low == high && low == a)) return true;
    }
    const glm::dvec2 least = glm::min(triangle[0], glm::min(triangle[1], triangle[2]));
    const glm::dvec2 most = glm::max(triangle[0], glm::max(triangle[1], triangle[2]));
    return low.x > most.x || low.y > most.y || high.x < least.x || high.y < least.y;
}

bool contains(const std::array<glm::dvec2, 3>& t, const glm::dvec2& p) {
    const bool is_corner = p == t[0] || p == t[1] || p == t[2];
    return !is_corner && turn(t[0], t[1], p) >= 0.0 && turn(t[1], t[2], p) >= 0.0 &&
           turn(t[2], t[0], p) >= 0.0;
}

} // namespace

PointHierarchy::PointHierarchy(std::span<const glm::dvec2> points)
    : points_(points), order_(points.size()), positions_(points.size()), gone_(points.size(), 0) {
    std::iota(order_.begin(), order_.end(), 0u);
    size_t leaves = 1; // of the complete hierarchy that is built
    while (leaves * LEAF < points.size()) leaves *= 2;
    nodes_.resize(2 * leaves - 1);
    build(0, 0, points.size());
    for (uint32_t i = 0; i < order_.size(); ++i) positions_[order_[i]] = i;
}

void PointHierarchy::build(size_t node, size_t begin, size_t end) {
    glm::dvec2 low(points_[order_[begin]]), high(low);
    for (size_t i = begin; i < end; ++i) {
        low = glm::min(low, points_[order_[i]]);
        high = glm::max(high, points_[order_[i]]);
    }
    nodes_[node] = {low, high, uint32_t(end - begin)};
    if (end - begin <= LEAF) return;
    const size_t middle = begin + (end - begin) / 2, axis = high.x - low.x < high.y - low.y;
    const auto at = [&](size_t i) { return order_.begin() + std::ptrdiff_t(i); };
    std::nth_element(at(begin), at(middle), at(end),
                     [&](uint32_t a, uint32_t b) { return points_[a][axis] < points_[b][axis]; });
    build(2 * node + 1, begin, middle);
    build(2 * node + 2, middle, end);
}

void PointHierarchy::remove(uint32_t point) {
    const size_t position = positions_[point];
    gone_[position] = 1;
    size_t node = 0, begin = 0, end = points_.size();
    for (--nodes_[0].count; end - begin > LEAF; --nodes_[node].count) {
        const size_t middle = begin + (end - begin) / 2;
        const bool right = position >= middle;
        node = 2 * node + (right ? 2 : 1);
        (right ? begin : end) = middle;
    }
}

bool PointHierarchy::any_in(const std::array<glm::dvec2, 3>& triangle) {
    return any_in(triangle, 0, 0, points_.size());
}

bool PointHierarchy::any_in(const std::array<glm::dvec2, 3>& triangle, size_t node, size_t begin,
                            size_t end) {
    ++steps_;
    const Node& box = nodes_[node];
    if (box.count == 0 || misses(triangle, box.low, box.high)) return false;
    if (end - begin <= LEAF) {
        for (size_t i = begin; i < end; ++i)
            if (!gone_[i] && contains(triangle, points_[order_[i]])) return true;
        return false;
    }
    const size_t middle = begin + (end - begin) / 2;
    return any_in(triangle, 2 * node + 1, begin, middle) ||
           any_in(triangle, 2 * node + 2, middle, end);
}

} // namespace onde
