// The oriented box: principal directions first, then turned until no small angle helps.
#include "accel/volume_rounding.h"
#include "accel/volumes.h"

#include <glm/gtc/matrix_transform.hpp>

#include <vector>

namespace onde {

using namespace accel;

namespace {

glm::dmat3 covariance(std::span<const glm::vec3> points) {
    glm::dvec3 mean(0.0);
    for (const glm::vec3& point : points) mean += glm::dvec3(point) / double(points.size());
    glm::dmat3 sum(0.0);
    for (const glm::vec3& point : points) {
        const glm::dvec3 d = glm::dvec3(point) - mean;
        sum += glm::outerProduct(d, d);
    }
    return sum;
}

/// Columns are the eigenvectors of a symmetric matrix, by Jacobi's rotations.
glm::dmat3 eigenvectors(glm::dmat3 m) {
    glm::dmat3 vectors(1.0);
    for (int sweep = 0; sweep < 32; ++sweep)
        for (glm::length_t p = 0; p < 2; ++p)
            for (glm::length_t q = p + 1; q < 3; ++q) {
                if (m[q][p] == 0) continue;
                const double angle = 0.5 * std::atan2(2 * m[q][p], m[q][q] - m[p][p]);
                glm::dmat3 turn(1.0);
                turn[p][p] = turn[q][q] = std::cos(angle);
                turn[p][q] = -std::sin(angle);
                turn[q][p] = std::sin(angle);
                m = glm::transpose(turn) * m * turn;
                vectors = vectors * turn;
            }
    return vectors;
}

double box_volume(std::span<const glm::vec3> points, const glm::dmat3& axes) {
    double volume = 1;
    for (glm::length_t k = 0; k < 3; ++k) {
        const Cover covered = cover(points, axes[k]);
        volume *= covered.high - covered.low;
    }
    return volume;
}

glm::dmat3 turned(const glm::dmat3& axes, glm::length_t about, double angle) {
    return glm::dmat3(glm::rotate(glm::dmat4(1.0), angle, axes[about])) * axes;
}

/// An orientation and what the box along it takes up.
struct Candidate {
    glm::dmat3 axes;
    double volume;
};

Candidate improved(std::span<const glm::vec3> points, Candidate best) {
    constexpr double FIRST_ANGLE = 0.35, LAST_ANGLE = 1e-3; // radians
    for (double angle = FIRST_ANGLE; angle > LAST_ANGLE;) {
        const double before = best.volume;
        for (glm::length_t about = 0; about < 3; ++about)
            for (double signed_angle : {angle, -angle}) {
                const glm::dmat3 axes = turned(best.axes, about, signed_angle);
                const double volume = box_volume(points, axes);
                if (volume < best.volume) best = {axes, volume};
            }
        if (best.volume >= 0.999 * before) angle *= 0.5;
    }
    return best;
}

/// The points that are farthest out along each of many directions: the box of these is nearly that
/// of all, in any orientation.
std::vector<glm::vec3> outermost(std::span<const glm::vec3> points) {
    constexpr size_t DIRECTIONS = 256, FEW = 1024;
    if (points.size() <= FEW) return {points.begin(), points.end()};
    std::vector<glm::vec3> chosen;
    for (size_t i = 0; i < DIRECTIONS; ++i) { // along a spiral from pole to pole
        const double z = 1 - (2 * double(i) + 1) / DIRECTIONS, angle = 2.39996323 * double(i);
        const double r = std::sqrt(1 - z * z);
        const glm::vec3 direction(r * std::cos(angle), r * std::sin(angle), z);
        chosen.push_back(*std::ranges::max_element(
            points, {}, [&](const glm::vec3& p) { return glm::dot(direction, p); }));
    }
    return chosen;
}

} // namespace

OrientedBoxVolume fit_oriented_box(std::span<const glm::vec3> points) {
    const std::vector<glm::vec3> outer = outermost(points);
    Candidate best{glm::dmat3(1.0), box_volume(points, glm::dmat3(1.0))};
    for (const glm::dmat3& start : {glm::dmat3(1.0), eigenvectors(covariance(points))}) {
        const Candidate found = improved(outer, {start, box_volume(outer, start)});
        for (const glm::dmat3& axes : {start, found.axes}) {
            const double volume = box_volume(points, axes);
            if (volume < best.volume) best = {axes, volume};
        }
    }
    OrientedBoxVolume box{};
    for (glm::length_t k = 0; k < 3; ++k) {
        const glm::vec3 axis(best.axes[k]); // as the device has it
        for (glm::length_t i = 0; i < 3; ++i) box.axes[3 * k + i] = axis[i];
        const Cover covered = cover(points, glm::dvec3(axis));
        box.low[k] = round_down(covered.low);
        box.high[k] = round_up(covered.high);
    }
    box.reach = reach_of(points);
    return box;
}

} // namespace onde
