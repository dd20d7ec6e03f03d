// Suns and photometric lights on the device: what their samples and emissions are distributed as.
#pragma once

#include "doctor/light_rig.h"

namespace onde::doctor::lights {

/// What rays of those directions find of the scene's first light, a sun: radiance (3), density.
inline Columns look_at_sun(SceneProbe& probe, const std::vector<glm::vec3>& directions) {
    Columns in;
    add_vectors(in, directions);
    return probe.run("sun", in, 4);
}

/// A chi-square test of samples against a disk of even density; empty when they agree.
inline std::string disk_failure(const LightSamples& samples, glm::vec3 middle, double opening,
                                double significance) {
    constexpr size_t RINGS = 8, SECTORS = 8; // of equal solid angle
    const glm::dvec3 axis(middle), s = glm::normalize(glm::cross(axis, glm::dvec3(0, 1, 0)));
    const glm::dvec3 t = glm::cross(axis, s);
    std::vector<double> observed(RINGS * SECTORS);
    for (const glm::vec3 sample : samples.direction) {
        const glm::dvec3 off = glm::dvec3(sample) - axis;
        const double ring = 0.5 * glm::dot(off, off) / opening * RINGS;
        const double turn = std::atan2(glm::dot(off, t), glm::dot(off, s)) / (2 * M_PI) + 0.5;
        if (!(ring < RINGS * (1 + 1e-3))) return "a sample lies beside the disk";
        observed[std::min(size_t(ring), RINGS - 1) * SECTORS +
                 std::min(size_t(turn * SECTORS), SECTORS - 1)]++;
    }
    const double each = double(samples.direction.size()) / (RINGS * SECTORS);
    return chi_square_failure(observed, std::vector(observed.size(), each), significance);
}

/// A direction of a profile's space, from the light.
inline glm::dvec3 profile_direction(double polar, double around) {
    return {std::sin(polar) * std::cos(around), -std::sin(polar) * std::sin(around),
            std::cos(polar)};
}

/// What the scene's first light, a photometric one, does: the value (1) in each direction, and a
/// direction (3) that two numbers each sample, with its density.
inline Columns ask_profile(SceneProbe& probe, const std::vector<glm::vec3>& directions,
                           const Column& u, const Column& v) {
    Columns in;
    add_vectors(in, directions);
    in.push_back(u);
    in.push_back(v);
    return probe.run("profile", in, 5);
}

/// W, by quadrature of the bilinear values between nodes.
inline double emitted_power(const LightProfile& profile) {
    constexpr int STEPS = 64; // in a cell, each way
    double sum = 0;
    for (uint32_t row = 0; row < profile.rows; row++)
        for (int i = 0; i < STEPS; i++) {
            const double down = (i + 0.5) / STEPS;
            const double sine = std::sin(M_PI * (row + down) / profile.rows);
            for (uint32_t column = 0; column < profile.columns; column++) {
                const double upper = profile.node(row, column) + profile.node(row, column + 1);
                const double lower =
                    profile.node(row + 1, column) + profile.node(row + 1, column + 1);
                sum += sine * 0.5 * (upper + (lower - upper) * down);
            }
        }
    return sum * M_PI / (profile.rows * STEPS) * 2 * M_PI / profile.columns / LUMENS_PER_WATT;
}

/// A chi-square test of emitted directions against the cells' brightest corners times their solid
/// angles, and whether the densities that they state integrate the profile to what it emits; empty
/// when they agree.
inline std::string profile_failure(SceneProbe& probe, const LightProfile& profile, size_t count,
                                   double significance) {
    Generator generator(76);
    const Columns out =
        ask_profile(probe, std::vector(count, glm::vec3(0, 0, 1)), uniform_column(generator, count),
                    uniform_column(generator, count));
    std::vector<double> observed(profile.rows * profile.columns), expected;
    double all = 0, power = 0;
    for (uint32_t row = 0; row < profile.rows; row++) {
        const double height =
            std::cos(M_PI * row / profile.rows) - std::cos(M_PI * (row + 1) / profile.rows);
        for (uint32_t column = 0; column < profile.columns; column++) {
            const std::array corners{profile.node(row, column), profile.node(row, column + 1),
                                     profile.node(row + 1, column),
                                     profile.node(row + 1, column + 1)};
            const double brightest = double(*std::ranges::max_element(corners));
            expected.push_back(brightest * height);
            all += expected.back();
        }
    }
    for (double& cell : expected) cell *= double(count) / all;
    std::vector<glm::vec3> directions;
    for (size_t i = 0; i < count; i++) {
        const glm::dvec3 d(vector_at(out, 1, i));
        directions.emplace_back(d);
        const double polar = std::acos(std::clamp(d.z, -1.0, 1.0)) / M_PI;
        const double turn = std::atan2(-d.y, d.x) / (2 * M_PI);
        const auto row = std::min(uint32_t(polar * profile.rows), profile.rows - 1);
        const auto column =
            std::min(uint32_t((turn - std::floor(turn)) * profile.columns), profile.columns - 1);
        observed[row * profile.columns + column]++;
    }
    const Columns values =
        ask_profile(probe, directions, constant_column(count, 0.5f), constant_column(count, 0.5f));
    double squares = 0;
    for (size_t i = 0; i < count; i++) {
        const double weight = double(values[0][i]) / double(out[4][i]) / double(count);
        power += weight;
        squares += weight * weight * double(count);
    }
    const double stated = emitted_power(profile);
    const double deviation = std::sqrt(std::max(squares - power * power, 0.0) / double(count));
    if (std::abs(power - stated) > 5 * deviation + 1e-5 * stated)
        return fmt::format("emits {} instead of {}", power, stated);
    return chi_square_failure(observed, expected, significance);
}

} // namespace onde::doctor::lights
