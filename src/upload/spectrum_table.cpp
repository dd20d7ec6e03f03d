#include "upload/spectrum_table.h"

#include "scene/spectrum/cie.h"

#include <algorithm>

namespace onde {
namespace {

constexpr int FIRST = 390, LAST = 730; ///< nm; beyond, the eye sees next to nothing
constexpr int STEPS = LAST - FIRST;

/// The middle of a step.
double wavelength_of(int step) {
    return FIRST + step + 0.5;
}

/// What each step has of white, which is the sum of all.
std::vector<glm::dvec3> parts_of_white() {
    std::vector<glm::dvec3> parts;
    glm::dvec3 sum(0.0);
    for (int i = 0; i < STEPS; i++) {
        const double wavelength = wavelength_of(i);
        const glm::dvec3 color =
            spectrum::d65(wavelength) * spectrum::color_of_wavelength(wavelength);
        parts.push_back(glm::max(color, 0.0));
        sum += parts.back();
    }
    for (glm::dvec3& part : parts) part /= sum;
    return parts;
}

/// By Cauchy's formula through the lines F, d and C (KHR_materials_dispersion): times ior - 1 over
/// the Abbe number it is what the index is greater than that of the d line.
double bend_of(double wavelength) {
    return 523655.0 / (wavelength * wavelength) - 1.5168;
}

double density(const glm::dvec3& part) {
    return (part.r + part.g + part.b) / 3.0;
}

} // namespace

std::vector<SpectrumKnot> spectrum_table() {
    const std::vector<glm::dvec3> parts = parts_of_white();
    std::vector<SpectrumKnot> knots(SPECTRUM_KNOTS);
    int step = 0;
    double before = 0.0; // the probability of the steps before
    for (uint32_t k = 0; k < SPECTRUM_KNOTS; k++) {
        const double u = double(k) / (SPECTRUM_KNOTS - 1);
        while (step + 1 < STEPS && before + density(parts[size_t(step)]) < u)
            before += density(parts[size_t(step++)]);
        const glm::dvec3& part = parts[size_t(step)];
        const double inside = std::clamp((u - before) / density(part), 0.0, 1.0);
        const glm::dvec3 color = part / density(part);
        knots[k] = {float(bend_of(FIRST + step + inside)),
                    {float(color.r), float(color.g), float(color.b)}};
    }
    // The mean of what is linear between knots.
    glm::dvec3 mean(0.0);
    for (uint32_t k = 0; k < SPECTRUM_KNOTS; k++) {
        const bool end = k == 0 || k + 1 == SPECTRUM_KNOTS;
        const float* c = knots[k].color;
        mean += (end ? 0.5 : 1.0) / (SPECTRUM_KNOTS - 1) * glm::dvec3(c[0], c[1], c[2]);
    }
    for (SpectrumKnot& knot : knots)
        for (int c = 0; c < 3; c++) knot.color[c] = float(knot.color[c] / mean[c]);
    return knots;
}

} // namespace onde
