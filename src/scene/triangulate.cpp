#include "scene/triangulate.h"

#include "scene/point_hierarchy.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace onde {

namespace {

/// The polygon seen along its normal (Newell's), counter-clockwise.
std::vector<glm::dvec2> project(const Polygon& polygon) {
    const size_t n = polygon.size();
    glm::dvec3 normal(0.0);
    for (size_t i = 0; i < n; ++i)
        normal += glm::cross(polygon[i] - polygon[0], polygon[(i + 1) % n] - polygon[0]);
    size_t drop = 0;
    for (size_t axis = 1; axis < 3; ++axis)
        if (std::abs(normal[axis]) > std::abs(normal[drop])) drop = axis;
    size_t u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0.0) std::swap(u, v);
    std::vector<glm::dvec2> flat;
    flat.reserve(n);
    for (size_t i = 0; i < n; ++i) flat.emplace_back(polygon[i][u], polygon[i][v]);
    return flat;
}

/// The edges of a polygon that does not cross itself make a plane graph, each from one side or
/// from both: of V positions that has less than 3 V edges.
bool may_have_ears(const Polygon& polygon) {
    return polygon.size() < 6 * polygon.positions.size();
}

bool is_convex(const std::vector<glm::dvec2>& p) {
    for (size_t i = 0; i < p.size(); ++i)
        if (turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0.0) return false;
    return true;
}

/// Clips ears off a polygon. Cutting one can make ears of its two neighbours only, since what is
/// left lies within what was there before; so every corner is tested once, and after each cut two.
class EarClipper {
  public:
    explicit EarClipper(const std::vector<glm::dvec2>& polygon)
        : p_(polygon), points_(polygon), before_(polygon.size()), after_(polygon.size()),
          most_steps_(most_steps(polygon.size())) {
        const auto n = uint32_t(polygon.size());
        for (uint32_t i = 0; i < n; ++i) {
            before_[i] = (i + n - 1) % n;
            after_[i] = (i + 1) % n;
        }
    }

    /// Cuts until three corners are left or none is an ear; adds the triangles and returns the
    /// corners that are left, in their order.
    std::vector<uint32_t> clip(std::vector<std::array<uint32_t, 3>>& triangles) {
        std::vector<uint32_t> rest(p_.size());
        std::iota(rest.begin(), rest.end(), 0u);
        // Where a polygon touches or crosses itself, a cut far away may make an ear.
        for (size_t round = 0; round < MAX_ROUNDS && rest.size() > 3; ++round) {
            const size_t before = rest.size();
            rest = clip_once(rest, triangles);
            if (rest.size() == before) break;
        }
        return rest;
    }

  private:
    static constexpr size_t MAX_ROUNDS = 8;

    /// Several times what polygons take that do not cross themselves, and seconds at most.
    static uint64_t most_steps(size_t corners) {
        constexpr uint64_t PER_LEVEL = 64, MOST = uint64_t(1) << 31;
        return std::min(PER_LEVEL * corners * std::bit_width(corners), MOST);
    }

    std::vector<uint32_t> clip_once(std::vector<uint32_t> candidates,
                                    std::vector<std::array<uint32_t, 3>>& triangles) {
        size_t left = candidates.size();
        uint32_t first = candidates[0];
        for (size_t next = 0; next < candidates.size() && left > 3; ++next) {
            const uint32_t corner = candidates[next], a = before_[corner], b = after_[corner];
            if (a == corner || !is_ear(corner)) continue; // it is gone, or no ear
            triangles.push_back({a, corner, b});
            points_.remove(corner);
            after_[a] = b;
            before_[b] = a;
            before_[corner] = after_[corner] = corner;
            --left;
            first = a;
            candidates.push_back(a);
            candidates.push_back(b);
        }
        std::vector<uint32_t> rest{first};
        while (rest.size() < left) rest.push_back(after_[rest.back()]);
        return rest;
    }

    bool is_ear(uint32_t corner) {
        const std::array<glm::dvec2, 3> ear{p_[before_[corner]], p_[corner], p_[after_[corner]]};
        return points_.steps() < most_steps_ && turn(ear[0], ear[1], ear[2]) > 0.0 &&
               !points_.any_in(ear);
    }

    const std::vector<glm::dvec2>& p_;
    PointHierarchy points_; ///< corners that are left
    std::vector<uint32_t> before_, after_;
    uint64_t most_steps_; ///< in the hierarchy
};

} // namespace

std::vector<std::array<uint32_t, 3>> triangulate(const Polygon& polygon) {
    std::vector<std::array<uint32_t, 3>> triangles;
    if (polygon.size() < 3) return triangles;
    triangles.reserve(polygon.size() - 2);
    std::vector<uint32_t> rest(polygon.size());
    std::iota(rest.begin(), rest.end(), 0u);
    if (polygon.size() > 3 && may_have_ears(polygon)) {
        const std::vector<glm::dvec2> flat = project(polygon);
        if (!is_convex(flat)) rest = EarClipper(flat).clip(triangles);
    }
    // A fan of what is left: all of a convex polygon, or what crosses itself.
    for (size_t i = 2; i < rest.size(); ++i) triangles.push_back({rest[0], rest[i - 1], rest[i]});
    return triangles;
}

} // namespace onde
