// The smallest enclosing sphere, as an active set: the smallest sphere of a few points, to which
// the point that lies farthest outside is added until none does.
#include "accel/volume_rounding.h"
#include "accel/volumes.h"

#include <optional>
#include <vector>

namespace onde {

using namespace accel;

namespace {

struct Ball {
    glm::dvec3 center{0.0};
    double radius = -1; ///< negative: contains nothing
};

using Support = std::vector<glm::dvec3>; // at most five

constexpr double TOLERANCE = 1e-9;

/// The smallest sphere that passes through all of one to four points; nothing where they do not
/// determine one.
std::optional<Ball> circumscribed(const Support& points) {
    const glm::dvec3 origin = points[0];
    // The centre is origin + sum of x_i edge_i with 2 edge_i . centre' = edge_i^2.
    glm::dmat3 gram(1.0);
    glm::dvec3 right(0.0);
    for (size_t i = 1; i < points.size(); ++i) {
        const glm::dvec3 edge = points[i] - origin;
        right[glm::length_t(i - 1)] = 0.5 * glm::dot(edge, edge);
        for (size_t j = 1; j < points.size(); ++j)
            gram[glm::length_t(j - 1)][glm::length_t(i - 1)] = glm::dot(edge, points[j] - origin);
    }
    const double scale = gram[0][0] * gram[1][1] * gram[2][2];
    if (!(std::abs(glm::determinant(gram)) > 1e-14 * scale)) return std::nullopt;
    const glm::dvec3 x = glm::inverse(gram) * right;
    glm::dvec3 center(0.0);
    for (size_t i = 1; i < points.size(); ++i)
        center += x[glm::length_t(i - 1)] * (points[i] - origin);
    return Ball{origin + center, glm::length(center)};
}

bool contains(const Ball& ball, const Support& points) {
    return std::ranges::all_of(points, [&](const glm::dvec3& p) {
        return glm::length(p - ball.center) <= ball.radius * (1 + TOLERANCE);
    });
}

/// The smallest sphere of up to five points, and which of them it rests on.
struct Resting {
    Ball ball;
    Support support;
};

Resting smallest(const Support& points) {
    Resting best;
    for (uint32_t subset = 1; subset < 1u << points.size(); ++subset) {
        Support chosen;
        for (size_t i = 0; i < points.size(); ++i)
            if (subset >> i & 1) chosen.push_back(points[i]);
        if (chosen.size() > 4) continue;
        const std::optional<Ball> ball = circumscribed(chosen);
        if (!ball || !contains(*ball, points)) continue;
        if (best.support.empty() || ball->radius < best.ball.radius) best = {*ball, chosen};
    }
    return best;
}

glm::vec3 farthest(std::span<const glm::vec3> points, glm::dvec3 from) {
    return *std::ranges::max_element(points, {}, [&](const glm::vec3& p) {
        const glm::dvec3 d = glm::dvec3(p) - from;
        return glm::dot(d, d);
    });
}

} // namespace

SphereVolume fit_sphere(std::span<const glm::vec3> points) {
    constexpr int MOST_STEPS = 256; // far more than it takes; rounding must not make it endless
    Resting found{{glm::dvec3(points[0]), 0.0}, {glm::dvec3(points[0])}};
    for (int step = 0; step < MOST_STEPS; ++step) {
        const glm::dvec3 outside(farthest(points, found.ball.center));
        if (glm::length(outside - found.ball.center) <= found.ball.radius * (1 + 1e-7)) break;
        Support next = found.support;
        next.push_back(outside);
        const Resting larger = smallest(next);
        if (larger.support.empty() || larger.ball.radius <= found.ball.radius) break;
        found = larger;
    }
    const glm::vec3 center(found.ball.center); // as the device has it
    const glm::dvec3 exact(center);
    const double radius = glm::length(glm::dvec3(farthest(points, exact)) - exact);
    return {{center.x, center.y, center.z}, round_up(radius * (1 + TOLERANCE))};
}

} // namespace onde
