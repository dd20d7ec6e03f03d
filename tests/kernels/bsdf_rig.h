// BSDFs on the device: evaluated, sampled, integrated over the sphere.
#pragma once

#include "kernels/scene_probe.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

namespace onde::test::bsdf {

inline Probe& probe() {
    static Probe built("bsdf.cl", 1, {"bsdf_eval", "bsdf_sample"});
    return built;
}

/// Bsdf of kernels/shade/bsdf.h.
struct Surface {
    std::string name;
    glm::vec3 diffuse, f0;
    float f90 = 1, alpha = 1, glossy = 1, eta = 1;
    bool dielectric = false;

    Columns columns(size_t count) const {
        Columns columns;
        for (float a : {diffuse.x, diffuse.y, diffuse.z, f0.x, f0.y, f0.z, f90, alpha, glossy, eta,
                        dielectric ? 1.0f : 0.0f})
            columns.push_back(constant_column(count, a));
        return columns;
    }
};

inline Surface diffuse() {
    return {"diffuse", glm::vec3(0.8f, 0.5f, 1.0f), glm::vec3(0), 0, 1, 0};
}
inline Surface conductor(float alpha, float f0 = 1) {
    return {fmt::format("conductor {}", alpha), glm::vec3(0), glm::vec3(f0), 1, alpha, 1};
}
inline Surface mix(float alpha, float metallic) {
    const glm::vec3 color(1.0f, 0.8f, 0.3f);
    return {fmt::format("mix {} {}", alpha, metallic),
            color * (1 - metallic),
            glm::mix(glm::vec3(0.04f), color, metallic),
            1,
            alpha,
            0.3f};
}
inline Surface glass(float alpha, float eta) {
    return {fmt::format("glass {} {}", alpha, eta),
            glm::vec3(1),
            glm::vec3(0.04f),
            1,
            alpha,
            1,
            eta,
            true};
}

/// Directions above, from normal to grazing.
inline std::vector<glm::vec3> outgoing() {
    std::vector<glm::vec3> directions;
    for (double cosine : {1.0, 0.8, 0.4, 0.1}) {
        const double sine = std::sqrt(1 - cosine * cosine);
        directions.emplace_back(sine * std::cos(0.7), sine * std::sin(0.7), cosine);
    }
    return directions;
}

struct Values {
    Columns value; ///< times cosine, 3 columns
    Column pdf;
};

inline Values evaluate(const Surface& surface, const std::vector<glm::vec3>& wo,
                       const std::vector<glm::vec3>& wi) {
    Columns in = surface.columns(wi.size());
    add_vectors(in, wo);
    add_vectors(in, wi);
    Columns out = probe().run("bsdf_eval", in, 4);
    Values values;
    values.pdf = std::move(out[3]);
    out.pop_back();
    values.value = std::move(out);
    return values;
}

struct Samples {
    std::vector<glm::vec3> wi, weight;
    Column pdf, delta, valid;
};

inline Samples sample(const Surface& surface, glm::vec3 wo, size_t count, uint32_t seed) {
    Generator generator(seed);
    Columns in = surface.columns(count);
    add_vectors(in, std::vector<glm::vec3>(count, wo));
    for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, count));
    const Columns out = probe().run("bsdf_sample", in, 9);
    Samples samples;
    for (size_t i = 0; i < count; i++) {
        samples.wi.emplace_back(vector_at(out, 0, i));
        samples.weight.emplace_back(vector_at(out, 3, i));
    }
    samples.pdf = out[6];
    samples.delta = out[7];
    samples.valid = out[8];
    return samples;
}

/// Points of quadrature over the sphere: in each bin 6 x 8 cells, in each cell Gauss's 2 x 2.
struct Quadrature {
    SphereBins bins;
    std::vector<glm::vec3> directions;
    std::vector<double> weights; ///< solid angle
    std::vector<size_t> bin;

    Quadrature() {
        constexpr size_t CELLS = 6, SECTORS = 8;
        const double step = M_PI / double(bins.polar * CELLS);
        const double turn = 2 * M_PI / double(bins.around * SECTORS);
        for (size_t row = 0; row < 2 * bins.polar * CELLS; row++)
            for (size_t column = 0; column < 2 * bins.around * SECTORS; column++)
                add(place(row) * step, place(column) * turn, step * turn / 4,
                    row / (2 * CELLS) * bins.around + column / (2 * SECTORS));
    }

  private:
    /// Of Gauss point i, in cells.
    static double place(size_t i) {
        return double(i / 2) + 0.5 + (i % 2 ? 0.5 : -0.5) / std::sqrt(3.0);
    }
    void add(double theta, double phi, double area, size_t in) {
        const double sine = std::sin(theta);
        directions.emplace_back(sine * std::cos(phi), sine * std::sin(phi), std::cos(theta));
        weights.push_back(area * sine);
        bin.push_back(in);
    }
};

inline const Quadrature& quadrature() {
    static const Quadrature built;
    return built;
}

inline Values evaluate_sphere(const Surface& surface, glm::vec3 wo) {
    const auto& directions = quadrature().directions;
    return evaluate(surface, std::vector<glm::vec3>(directions.size(), wo), directions);
}

/// The integral over the sphere of a column that `weigh(direction)` scales.
template <class Weigh>
double integrate(const Column& column, const Weigh& weigh) {
    double sum = 0;
    for (size_t i = 0; i < column.size(); i++)
        sum += quadrature().weights[i] * double(column[i]) * weigh(quadrature().directions[i]);
    return sum;
}
inline double integrate(const Column& column) {
    return integrate(column, [](glm::vec3) { return 1.0; });
}

} // namespace onde::test::bsdf
