// BSDFs on the device: evaluated, sampled, integrated over the sphere.
#pragma once

#include "doctor/columns.h"
#include "doctor/statistics.h"

namespace onde::doctor::bsdf {

/// Of one width.
inline Probe make_probe(gpu::Programs& programs, uint32_t width) {
    return Probe(programs, "bsdf.cl", width, {"bsdf_eval", "bsdf_sample"});
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

inline Values evaluate(Probe& probe, const Surface& surface, const std::vector<glm::vec3>& wo,
                       const std::vector<glm::vec3>& wi) {
    Columns in = surface.columns(wi.size());
    add_vectors(in, wo);
    add_vectors(in, wi);
    Columns out = probe.run("bsdf_eval", in, 4);
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

inline Samples sample(Probe& probe, const Surface& surface, glm::vec3 wo, size_t count,
                      uint32_t seed) {
    Generator generator(seed);
    Columns in = surface.columns(count);
    add_vectors(in, std::vector<glm::vec3>(count, wo));
    for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, count));
    const Columns out = probe.run("bsdf_sample", in, 9);
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

    explicit Quadrature(const SphereBins& of = {}) : bins(of) {
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

inline Values evaluate_sphere(Probe& probe, const Quadrature& over, const Surface& surface,
                              glm::vec3 wo) {
    return evaluate(probe, surface, std::vector<glm::vec3>(over.directions.size(), wo),
                    over.directions);
}

/// The integral over the sphere of a column that `weigh(direction)` scales.
template <class Weigh>
double integrate(const Quadrature& over, const Column& column, const Weigh& weigh) {
    double sum = 0;
    for (size_t i = 0; i < column.size(); i++)
        sum += over.weights[i] * double(column[i]) * weigh(over.directions[i]);
    return sum;
}

/// A chi-square test of samples against the density that is evaluated over the sphere; empty when
/// they agree. `total` becomes the density's integral.
inline std::string distribution_failure(const Quadrature& over, const Column& pdf,
                                        const Samples& samples, double significance,
                                        double& total) {
    const auto count = double(samples.wi.size());
    std::vector<double> expected(over.bins.size()), observed(over.bins.size());
    total = 0;
    for (size_t i = 0; i < pdf.size(); i++) {
        const double share = double(pdf[i]) * over.weights[i];
        expected[over.bin[i]] += count * share;
        total += share;
    }
    expected[over.bins.nowhere()] = count * std::max(1 - total, 0.0);
    for (size_t i = 0; i < samples.wi.size(); i++) {
        const glm::vec3 wi = samples.wi[i];
        observed[samples.valid[i] != 0 ? over.bins.find(wi.x, wi.y, wi.z) : over.bins.nowhere()]++;
    }
    return chi_square_failure(observed, expected, significance);
}

/// glTF 2.0, appendix B: GGX with height-correlated masking over Lambert, of which the dielectric
/// half lets a part through; times cosine.
inline glm::dvec3 mix_value(const Surface& surface, glm::dvec3 wo, glm::dvec3 wi) {
    const glm::dvec3 h = glm::normalize(wo + wi), f0(surface.f0), white(surface.f90);
    const double a2 = std::pow(double(surface.alpha), 2);
    const double d = a2 / (M_PI * std::pow(h.z * h.z * (a2 - 1) + 1, 2));
    const auto root = [&](double c) { return std::sqrt(a2 + (1 - a2) * c * c); };
    const double visibility = 0.5 / (wi.z * root(wo.z) + wo.z * root(wi.z));
    const double grazing = std::pow(1 - glm::dot(wo, h), 5);
    const glm::dvec3 fresnel = f0 + (white - f0) * grazing;
    const double through = 1 - double(surface.f90) * (0.04 + 0.96 * grazing);
    return (through * glm::dvec3(surface.diffuse) / M_PI + fresnel * d * visibility) * wi.z;
}

/// Not quite to the horizon.
inline std::vector<glm::vec3> directions_above(Generator& generator, size_t count) {
    std::vector<glm::vec3> directions = unit_vectors(generator, count);
    for (glm::vec3& v : directions) v = glm::normalize(glm::vec3(v.x, v.y, std::abs(v.z) + 0.01f));
    return directions;
}

} // namespace onde::doctor::bsdf
