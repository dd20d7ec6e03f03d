// BSDFs on the device: evaluated, sampled, integrated over the sphere.
#pragma once

#include "doctor/columns.h"
#include "doctor/scene_probe.h"
#include "doctor/statistics.h"
#include "upload/albedo_tables.h"

namespace onde::doctor::bsdf {

/// A face of a material.
struct Surface {
    std::string name;
    Material material;
    bool front = true;
    float bend = 0;     ///< of the light's wavelength, as of SpectrumKnot
    uint32_t index = 0; ///< among the materials of its Bsdfs

    bool is_glass() const { return lobes_of(material) & (1u << LOBE_DIELECTRIC | 1u << LOBE_THIN); }
    double alpha() const { return double(material.roughness) * double(material.roughness); }
    /// The index below over that above.
    double eta() const {
        if (material.thin_walled) return 1;
        return front ? double(material.ior) : 1 / double(material.ior);
    }
};

inline Surface surface_of(MaterialKind kind, float alpha, glm::vec3 color) {
    Surface surface;
    surface.name = fmt::format("{} {}", word_of(kind), alpha);
    surface.material.kind = kind;
    surface.material.base_color = color;
    surface.material.roughness = std::sqrt(alpha);
    return surface;
}
inline Surface diffuse() {
    return surface_of(MaterialKind::diffuse, 1, {0.8f, 0.5f, 1.0f});
}
inline Surface conductor(float alpha, float f0 = 1) {
    return surface_of(MaterialKind::conductor, alpha, glm::vec3(f0));
}
inline Surface mix(float alpha, float metallic, glm::vec3 color = {1.0f, 0.8f, 0.3f}) {
    Surface surface = surface_of(MaterialKind::metallic_roughness, alpha, color);
    surface.name += fmt::format(" {}", metallic);
    surface.material.metallic = metallic;
    return surface;
}
/// Seen from inside where front is false.
inline Surface glass(float alpha, float ior, bool front = true) {
    Surface surface = surface_of(MaterialKind::dielectric, alpha, glm::vec3(1));
    surface.name += fmt::format(" {} from {}", ior, front ? "outside" : "inside");
    surface.material.ior = ior;
    surface.front = front;
    return surface;
}

/// A mix of which a part is clear, thin or solid.
inline Surface clear_mix(float alpha, float metallic, float transmission, bool thin,
                         glm::vec3 color = glm::vec3(1)) {
    Surface surface = mix(alpha, metallic, color);
    surface.name += fmt::format(", {} clear, {}", transmission, thin ? "thin" : "solid");
    surface.material.transmission = transmission;
    surface.material.thin_walled = thin;
    return surface;
}
inline Surface pane(float alpha, float ior = 1.5f) {
    Surface surface = glass(alpha, ior);
    surface.name += ", thin";
    surface.material.thin_walled = true;
    return surface;
}

/// Surfaces on the device, at one width.
class Bsdfs {
  public:
    Bsdfs(gpu::Programs& programs, std::vector<Surface> surfaces, uint32_t width,
          const std::string& file = "bsdf.cl")
        : surfaces_(numbered(std::move(surfaces))),
          probe_(programs, scene_of(surfaces_), {"bsdf_eval", "bsdf_sample", "bsdf_lobes"}, width,
                 {}, {}, {}, file) {}

    const std::vector<Surface>& surfaces() const { return surfaces_; }
    const PackedScene& packed() const { return probe_.packed(); }
    SceneProbe& probe() { return probe_; }

  private:
    static std::vector<Surface> numbered(std::vector<Surface> surfaces) {
        for (uint32_t i = 0; i < surfaces.size(); i++) surfaces[i].index = i;
        return surfaces;
    }
    static Scene scene_of(const std::vector<Surface>& surfaces) {
        Scene scene;
        for (const Surface& surface : surfaces) scene.materials.push_back(surface.material);
        add_triangle(scene, {0, -1000, 0}, {0, -1000, 1}, {1, -1000, 0}, scene.materials[0]);
        return scene;
    }

    std::vector<Surface> surfaces_;
    SceneProbe probe_;
};

/// A probe's first columns.
inline Columns columns_of(const Surface& surface, size_t count) {
    return {constant_column(count, word(surface.index)),
            constant_column(count, surface.front ? 1.0f : 0.0f),
            constant_column(count, surface.bend)};
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

inline Values evaluate(Bsdfs& bsdfs, const Surface& surface, const std::vector<glm::vec3>& wo,
                       const std::vector<glm::vec3>& wi) {
    Columns in = columns_of(surface, wi.size());
    add_vectors(in, wo);
    add_vectors(in, wi);
    Columns out = bsdfs.probe().run("bsdf_eval", in, 4);
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

inline Samples sample(Bsdfs& bsdfs, const Surface& surface, glm::vec3 wo, size_t count,
                      uint32_t seed) {
    Generator generator(seed);
    Columns in = columns_of(surface, count);
    add_vectors(in, std::vector<glm::vec3>(count, wo));
    for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, count));
    const Columns out = bsdfs.probe().run("bsdf_sample", in, 9);
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

inline Values evaluate_sphere(Bsdfs& bsdfs, const Quadrature& over, const Surface& surface,
                              glm::vec3 wo) {
    return evaluate(bsdfs, surface, std::vector<glm::vec3>(over.directions.size(), wo),
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

/// A metal mixed with a body below a coat, in double precision; times cosine. Microfacets are GGX
/// with height-correlated masking, Schlick's reflectance and Turquin's compensation. Of the table
/// of albedos only its numbers are shared with the kernels.
class OpaqueValue {
  public:
    OpaqueValue(const Surface& surface, std::span<const uint32_t> table)
        : material_(surface.material), alpha_(surface.alpha()), table_(table) {
        if (material_.kind == MaterialKind::conductor) material_.metallic = 1;
    }

    glm::dvec3 operator()(glm::dvec3 wo, glm::dvec3 wi) const {
        const glm::dvec3 color(material_.base_color);
        if (material_.kind == MaterialKind::diffuse) return color / M_PI * wi.z;
        const AlbedoNumbers n = albedo_numbers(table_, wo.z, alpha_);
        const double white = alpha_ < SMOOTH_ALPHA ? 1 : n.first;
        const double offset = alpha_ < SMOOTH_ALPHA ? 0 : 2 * n.second - 1;
        const double grazing = white * (std::pow(1 - wo.z, 5) + offset);
        const glm::dvec3 metal = microfacets(color, wo, wi) * compensation(color, white);
        const glm::dvec3 f0(0.04), coat = microfacets(f0, wo, wi) * compensation(f0, white);
        const glm::dvec3 reflected = (f0 * white + (1.0 - f0) * grazing) * compensation(f0, white);
        const glm::dvec3 coated = coat + color * (1.0 - reflected) / M_PI;
        return glm::mix(coated, metal, double(material_.metallic)) * wi.z;
    }

    /// What leaves microfacets of reflectance f0 in all, over what does after one of them.
    static glm::dvec3 compensation(glm::dvec3 f0, double white) {
        return 1.0 + f0 * (1 - white) / white;
    }

  private:
    glm::dvec3 microfacets(glm::dvec3 f0, glm::dvec3 wo, glm::dvec3 wi) const {
        if (alpha_ < SMOOTH_ALPHA) return glm::dvec3(0);
        const glm::dvec3 h = glm::normalize(wo + wi);
        const double a2 = alpha_ * alpha_;
        const double d = a2 / (M_PI * std::pow(h.z * h.z * (a2 - 1) + 1, 2));
        const auto root = [&](double c) { return std::sqrt(a2 + (1 - a2) * c * c); };
        const double visibility = 0.5 / (wi.z * root(wo.z) + wo.z * root(wi.z));
        const double grazing = std::pow(1 - glm::dot(wo, h), 5);
        return (f0 + (1.0 - f0) * grazing) * d * visibility;
    }

    Material material_;
    double alpha_;
    std::span<const uint32_t> table_;
};

/// Not quite to the horizon.
inline std::vector<glm::vec3> directions_above(Generator& generator, size_t count) {
    std::vector<glm::vec3> directions = unit_vectors(generator, count);
    for (glm::vec3& v : directions) v = glm::normalize(glm::vec3(v.x, v.y, std::abs(v.z) + 0.01f));
    return directions;
}

} // namespace onde::doctor::bsdf
