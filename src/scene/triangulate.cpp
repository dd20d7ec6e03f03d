#include "scene/triangulate.h"

#include <cmath>
#include <numeric>

namespace onde {

namespace {

/// Twice the signed area of abc.
double turn(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

/// The polygon seen along its normal (Newell's), counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners) {
    glm::dvec3 normal(0.0);
    for (size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 a(corners[i] - corners[0]),
            b(corners[(i + 1) % corners.size()] - corners[0]);
        normal += glm::cross(a, b);
    }
    size_t drop = 0;
    for (size_t axis = 1; axis < 3; ++axis)
        if (std::abs(normal[axis]) > std::abs(normal[drop])) drop = axis;
    size_t u = (drop + 1) % 3, v = (drop + 2) % 3;
    if (normal[drop] < 0.0) std::swap(u, v);
    std::vector<glm::dvec2> flat;
    for (const glm::vec3& corner : corners) flat.emplace_back(corner[u], corner[v]);
    return flat;
}

bool is_convex(const std::vector<glm::dvec2>& p) {
    for (size_t i = 0; i < p.size(); ++i)
        if (turn(p[i], p[(i + 1) % p.size()], p[(i + 2) % p.size()]) < 0.0) return false;
    return true;
}

bool contains(const std::array<glm::dvec2, 3>& t, const glm::dvec2& p) {
    return turn(t[0], t[1], p) >= 0.0 && turn(t[1], t[2], p) >= 0.0 && turn(t[2], t[0], p) >= 0.0;
}

/// Whether corner i of the remaining polygon can be cut off.
bool is_ear(const std::vector<glm::dvec2>& p, const std::vector<size_t>& rest, size_t i) {
    const size_t n = rest.size(), before = rest[(i + n - 1) % n], after = rest[(i + 1) % n];
    const std::array<glm::dvec2, 3> ear{p[before], p[rest[i]], p[after]};
    if (turn(ear[0], ear[1], ear[2]) <= 0.0) return false;
    for (size_t other : rest) {
        const glm::dvec2& q = p[other];
        const bool is_corner = q == ear[0] || q == ear[1] || q == ear[2];
        if (!is_corner && contains(ear, q)) return false;
    }
    return true;
}

} // namespace

std::vector<std::array<size_t, 3>> triangulate(std::span<const glm::vec3> corners) {
    std::vector<std::array<size_t, 3>> triangles;
    if (corners.size() < 3) return triangles;
    const std::vector<glm::dvec2> flat = project(corners);
    std::vector<size_t> rest(corners.size());
    std::iota(rest.begin(), rest.end(), size_t(0));
    const bool convex = is_convex(flat);
    while (!convex && rest.size() > 3) {
        size_t ear = 0;
        while (ear < rest.size() && !is_ear(flat, rest, ear)) ++ear;
        if (ear == rest.size()) break; // crosses itself: a fan of what is left
        const size_t n = rest.size();
        triangles.push_back({rest[(ear + n - 1) % n], rest[ear], rest[(ear + 1) % n]});
        rest.erase(rest.begin() + std::ptrdiff_t(ear));
    }
    for (size_t i = 2; i < rest.size(); ++i) triangles.push_back({rest[0], rest[i - 1], rest[i]});
    return triangles;
}

} // namespace onde
