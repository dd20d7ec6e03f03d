// Finds a point of a set that lies in a triangle, while points leave the set.
#pragma once

#include <glm/glm.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace onde {

/// Twice the signed area of abc.
inline double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// A balanced binary hierarchy of bounding boxes over points of the plane.
class PointHierarchy {
  public:
    /// `points` must outlive the hierarchy.
    explicit PointHierarchy(std::span<const glm::dvec2> points);

    void remove(uint32_t point);

    /// Whether a point of the set lies in or on the triangle, which is counter-clockwise; points
    /// that equal one of its corners do not count.
    bool any_in(const std::array<glm::dvec2, 3>& triangle);

    /// Boxes that any_in() has looked at so far.
    uint64_t steps() const { return steps_; }

  private:
    struct Node {
        glm::dvec2 low, high;
        uint32_t count = 0; ///< of points that are left below it
    };

    void build(size_t node, size_t begin, size_t end);
    bool any_in(const std::array<glm::dvec2, 3>& triangle, size_t node, size_t begin, size_t end);

    std::span<const glm::dvec2> points_;
    std::vector<uint32_t> order_;     ///< points, each node's a range
    std::vector<uint32_t> positions_; ///< of each point in order_
    std::vector<char> gone_;          ///< by position in order_
    std::vector<Node> nodes_;         ///< the children of i are 2 i + 1 and 2 i + 2
    uint64_t steps_ = 0;
};

} // namespace onde
