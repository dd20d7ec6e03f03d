// BSDFs: samples against densities, weights against values, reciprocity, energy.
#include "kernels/scene_probe.h"
#include "kernels/statistics.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::test;

namespace {

Probe& probe() {
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

Surface diffuse() {
    return {"diffuse", glm::vec3(0.8f, 0.5f, 1.0f), glm::vec3(0), 0, 1, 0};
}
Surface conductor(float alpha, float f0 = 1) {
    return {fmt::format("conductor {}", alpha), glm::vec3(0), glm::vec3(f0), 1, alpha, 1};
}
Surface mix(float alpha, float metallic) {
    const glm::vec3 color(1.0f, 0.8f, 0.3f);
    return {fmt::format("mix {} {}", alpha, metallic),
            color * (1 - metallic),
            glm::mix(glm::vec3(0.04f), color, metallic),
            1,
            alpha,
            0.3f};
}
Surface glass(float alpha, float eta) {
    return {fmt::format("glass {} {}", alpha, eta),
            glm::vec3(1),
            glm::vec3(0.04f),
            1,
            alpha,
            1,
            eta,
            true};
}

std::vector<Surface> rough_surfaces() {
    return {diffuse(),         conductor(0.16f),      conductor(0.5f),      conductor(1.0f),
            mix(0.16f, 0.0f),  mix(0.5f, 0.5f),       mix(1.0f, 0.9f),      glass(0.2f, 1.5f),
            glass(0.5f, 1.5f), glass(0.2f, 1 / 1.5f), glass(0.5f, 1 / 1.5f)};
}

/// Directions above, from normal to grazing.
std::vector<glm::vec3> outgoing() {
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

Values evaluate(const Surface& surface, const std::vector<glm::vec3>& wo,
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

Samples sample(const Surface& surface, glm::vec3 wo, size_t count, uint32_t seed) {
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

const Quadrature& quadrature() {
    static const Quadrature built;
    return built;
}

Values evaluate_sphere(const Surface& surface, glm::vec3 wo) {
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
double integrate(const Column& column) {
    return integrate(column, [](glm::vec3) { return 1.0; });
}

/// What leaves toward wo in a white furnace, with refracted radiance in units of its own medium.
double albedo(const Surface& surface, const Column& value) {
    const double eta2 = surface.dielectric ? double(surface.eta) * surface.eta : 1.0;
    return integrate(value, [&](glm::vec3 wi) { return wi.z < 0 ? eta2 : 1.0; });
}

/// Not quite to the horizon.
std::vector<glm::vec3> directions_above(Generator& generator, size_t count) {
    std::vector<glm::vec3> directions = unit_vectors(generator, count);
    for (glm::vec3& v : directions) v = glm::normalize(glm::vec3(v.x, v.y, std::abs(v.z) + 0.01f));
    return directions;
}

/// glTF 2.0, appendix B: GGX with height-correlated masking over Lambert, of which the dielectric
/// half lets a part through; times cosine.
glm::dvec3 mix_value(const Surface& surface, glm::dvec3 wo, glm::dvec3 wi) {
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

} // namespace

TEST_CASE("BSDF samples are distributed as their pdf") {
    constexpr size_t COUNT = 1 << 17;
    const double significance = 1e-4 / double(rough_surfaces().size() * outgoing().size());
    const SphereBins bins = quadrature().bins;
    uint32_t seed = 1;
    for (const Surface& surface : rough_surfaces())
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            std::vector<double> expected(bins.size()), observed(bins.size());
            const Column pdf = evaluate_sphere(surface, wo).pdf;
            double total = 0;
            for (size_t i = 0; i < pdf.size(); i++) {
                const double share = double(pdf[i]) * quadrature().weights[i];
                expected[quadrature().bin[i]] += COUNT * share;
                total += share;
            }
            CHECK(total < 1 + 1e-3);
            expected[bins.nowhere()] = COUNT * std::max(1 - total, 0.0);
            const Samples samples = sample(surface, wo, COUNT, seed++);
            for (size_t i = 0; i < COUNT; i++) {
                const glm::vec3 wi = samples.wi[i];
                observed[samples.valid[i] != 0 ? bins.find(wi.x, wi.y, wi.z) : bins.nowhere()]++;
            }
            CHECK(chi_square_failure(observed, expected, significance) == "");
        }
}

TEST_CASE("the weight of a BSDF sample is value over pdf") {
    constexpr size_t COUNT = 4096;
    for (const Surface& surface : rough_surfaces())
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            Samples samples = sample(surface, wo, COUNT, 5);
            const Values values = evaluate(surface, std::vector(COUNT, wo), samples.wi);
            const auto error = [&](size_t i) {
                if (samples.valid[i] == 0) return 0.0;
                double largest = std::abs(samples.pdf[i] / values.pdf[i] - 1);
                for (uint32_t k = 0; k < 3; k++) {
                    const double wanted = values.value[k][i] / values.pdf[i];
                    largest = std::max(largest, std::abs(samples.weight[i][k] - wanted) /
                                                    std::max(wanted, 1e-3));
                }
                return largest;
            };
            CHECK(worst_item(COUNT, 1e-5, error, [&](size_t i) {
                      return fmt::format("weight {} for value {}, pdf {} and {}",
                                         samples.weight[i].x, values.value[0][i], samples.pdf[i],
                                         values.pdf[i]);
                  }) == "");
        }
}

TEST_CASE("opaque values are those of glTF's appendix B in double precision") {
    constexpr size_t COUNT = 1 << 14;
    Generator generator(2);
    const std::vector<glm::vec3> wo = directions_above(generator, COUNT);
    const std::vector<glm::vec3> wi = directions_above(generator, COUNT);
    for (const Surface& surface : rough_surfaces()) {
        if (surface.dielectric) continue;
        INFO(surface.name);
        const Columns value = evaluate(surface, wo, wi).value;
        for (uint32_t k = 0; k < 3; k++) {
            const auto wanted = [&](size_t i) {
                return mix_value(surface, glm::dvec3(wo[i]), glm::dvec3(wi[i]))[k];
            };
            CHECK(worst_ratio(value[k], wanted, 1e-4) == "");
        }
    }
}

TEST_CASE("the diffuse pdf integrates to one, and the diffuse albedo is the colour") {
    for (glm::vec3 wo : outgoing()) {
        const Values values = evaluate_sphere(diffuse(), wo);
        CHECK(integrate(values.pdf) == Approx(1).epsilon(1e-5));
        for (uint32_t k = 0; k < 3; k++)
            CHECK(integrate(values.value[k]) == Approx(diffuse().diffuse[k]).epsilon(1e-5));
    }
}

TEST_CASE("opaque surfaces are reciprocal") {
    constexpr size_t COUNT = 1 << 14;
    Generator generator(3);
    const std::vector<glm::vec3> a = directions_above(generator, COUNT);
    const std::vector<glm::vec3> b = directions_above(generator, COUNT);
    for (const Surface& surface : rough_surfaces()) {
        if (surface.dielectric) continue;
        INFO(surface.name);
        const Column there = evaluate(surface, a, b).value[0];
        const Column back = evaluate(surface, b, a).value[0];
        Column got(COUNT);
        for (size_t i = 0; i < COUNT; i++) got[i] = there[i] / b[i].z;
        CHECK(worst_ratio(
                  got, [&](size_t i) { return back[i] / a[i].z; }, 1e-4) == "");
    }
}

TEST_CASE("glass is reciprocal but for the squares of its indices") {
    constexpr size_t COUNT = 1 << 14;
    Generator generator(4);
    const std::vector<glm::vec3> above = directions_above(generator, COUNT);
    // Seen from the other side, below is above.
    const std::vector<glm::vec3> turned_below = directions_above(generator, COUNT);
    std::vector<glm::vec3> below, turned_above;
    for (size_t i = 0; i < COUNT; i++) {
        below.push_back(-turned_below[i]);
        turned_above.push_back(-above[i]);
    }
    for (float eta : {1.5f, 1 / 1.5f})
        for (float alpha : {0.2f, 0.6f}) {
            INFO("index " << eta << ", alpha " << alpha);
            const Column there = evaluate(glass(alpha, eta), above, below).value[0];
            const Column back =
                evaluate(glass(alpha, 1 / eta), turned_below, turned_above).value[0];
            const auto wanted = [&](size_t i) { return double(back[i]) / above[i].z; };
            Column got(COUNT);
            size_t lit = 0;
            for (size_t i = 0; i < COUNT; i++) {
                got[i] = there[i] / -below[i].z * eta * eta;
                lit += got[i] > 0;
            }
            CHECK(lit > COUNT / 10);
            // Near total reflection 1 - F loses its digits, and its values are small.
            CHECK(worst_ratio(got, wanted, 5e-3, 1e-2) == "");
        }
}

TEST_CASE("diffuse, metallic and glass surfaces reflect no more than they get") {
    for (const Surface& surface : rough_surfaces()) {
        const bool is_mix = surface.glossy > 0 && surface.glossy < 1;
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            // Where a white diffuse lobe is added, glTF's mix gains up to a fifth at grazing: it
            // takes from the diffuse lobe what the microfacets reflect, not what the surface does.
            const double bound = is_mix ? 1.2 : 1 + 1e-3;
            const Values values = evaluate_sphere(surface, wo);
            for (uint32_t k = 0; k < 3; k++) CHECK(albedo(surface, values.value[k]) < bound);
        }
    }
}

TEST_CASE("nearly smooth mirrors and glass lose almost nothing") {
    for (const Surface& surface : {conductor(0.02f), glass(0.02f, 1.5f), glass(0.02f, 1 / 1.5f)})
        for (glm::vec3 wo : {outgoing()[0], outgoing()[1]}) {
            INFO(surface.name << ", cosine " << wo.z);
            const Samples samples = sample(surface, wo, 1 << 14, 9);
            double sum = 0;
            for (size_t i = 0; i < samples.wi.size(); i++) {
                const double units = samples.wi[i].z < 0 ? std::pow(surface.eta, 2) : 1.0;
                if (samples.valid[i] != 0) sum += units * samples.weight[i].x;
            }
            CHECK(sum / double(samples.wi.size()) > 0.99);
            CHECK(sum / double(samples.wi.size()) < 1 + 1e-4);
        }
}

TEST_CASE("a smooth conductor mirrors, and its weight is its reflectance") {
    for (glm::vec3 wo : outgoing()) {
        const Samples samples = sample(conductor(0, 0.5f), wo, 64, 6);
        const double wanted = 0.5 + 0.5 * std::pow(1 - double(wo.z), 5);
        for (size_t i = 0; i < samples.wi.size(); i++) {
            REQUIRE((samples.delta[i] != 0 && samples.valid[i] != 0 && samples.pdf[i] == 0));
            REQUIRE(samples.wi[i] == glm::vec3(-wo.x, -wo.y, wo.z));
            REQUIRE(samples.weight[i].x == Approx(wanted).epsilon(1e-6));
        }
    }
}

TEST_CASE("smooth glass reflects by Fresnel's probability and refracts by Snell's law") {
    constexpr size_t COUNT = 1 << 14;
    for (float eta : {1.5f, 1 / 1.5f})
        for (glm::vec3 wo : outgoing()) {
            INFO("index " << eta << ", cosine " << wo.z);
            const Samples samples = sample(glass(0, eta), wo, COUNT, 7);
            size_t reflected = 0;
            for (size_t i = 0; i < COUNT; i++) {
                REQUIRE((samples.delta[i] != 0 && samples.valid[i] != 0));
                const glm::vec3 wi = samples.wi[i];
                if (wi.z > 0) {
                    reflected++;
                    REQUIRE(glm::length(wi - glm::vec3(-wo.x, -wo.y, wo.z)) < 1e-6f);
                    REQUIRE(samples.weight[i].x == 1.0f);
                } else {
                    REQUIRE(glm::length(glm::vec2(wi) + glm::vec2(wo) / eta) < 1e-6f);
                    REQUIRE(glm::length(wi) == Approx(1).epsilon(1e-6));
                    REQUIRE(samples.weight[i].x == Approx(1 / (eta * eta)).epsilon(1e-6));
                }
            }
            const double sine2 = (1 - double(wo.z) * double(wo.z)) / (double(eta) * double(eta));
            const double in = std::sqrt(std::max(1 - sine2, 0.0)), out = wo.z;
            const double p = (eta * out - in) / (eta * out + in);
            const double s = (out - eta * in) / (out + eta * in);
            const double wanted = sine2 >= 1 ? 1 : (p * p + s * s) / 2;
            const double deviation = std::sqrt(wanted * (1 - wanted) / COUNT);
            CHECK(double(reflected) / COUNT == Approx(wanted).margin(5 * deviation + 1e-6));
        }
}

TEST_CASE("delta lobes have no value and no pdf") {
    for (const Surface& surface : {conductor(0), glass(0, 1.5f)}) {
        const Values values = evaluate_sphere(surface, outgoing()[1]);
        CHECK(integrate(values.value[0]) == 0);
        CHECK(integrate(values.pdf) == 0);
    }
}

TEST_CASE("a smooth mix samples its diffuse lobe by the pdf of that lobe alone") {
    const Surface surface = mix(0, 0);
    const Values values = evaluate_sphere(surface, outgoing()[1]);
    CHECK(integrate(values.pdf) == Approx(1 - surface.glossy).epsilon(1e-5));
    const Samples samples = sample(surface, outgoing()[1], 1 << 14, 8);
    double sum = 0, deltas = 0;
    for (size_t i = 0; i < samples.wi.size(); i++) {
        sum += samples.delta[i] != 0 ? 0.0 : double(samples.weight[i].x);
        deltas += samples.delta[i];
    }
    const double count = double(samples.wi.size());
    CHECK(deltas / count == Approx(surface.glossy).margin(5 * 0.5 / std::sqrt(count)));
    // Weights are at most 1 / (1 - glossy).
    CHECK(sum / count ==
          Approx(integrate(values.value[0])).margin(5 / (1 - surface.glossy) / std::sqrt(count)));
}

TEST_CASE(
    "a material's lobes are those of its kind, chosen with probabilities that add up to one") {
    constexpr size_t COUNT = 1 << 10;
    Generator generator(77);
    Scene scene = scene_with_a_speck();
    scene.materials.resize(COUNT);
    Columns in(3);
    for (size_t i = 0; i < COUNT; i++) {
        Material& material = scene.materials[i];
        material.kind = MaterialKind(i % 4);
        material.base_color = glm::vec3(unit(generator), unit(generator), unit(generator));
        material.roughness = unit(generator);
        material.metallic = i % 3 == 0 ? 0.0f : unit(generator);
        in[0].push_back(word(uint32_t(i)));
        in[1].push_back(float(i / 4 % 2));
        in[2].push_back(0.01f + 0.99f * unit(generator));
    }
    const Columns out = SceneProbe(scene, {"material"}).run("material", in, 2 * LOBE_COUNT);
    const uint32_t kinds[LOBE_COUNT] = {
#define KINDS_OF_LOBE(NAME, name, Type, transmits, kinds) kinds,
        LOBES(KINDS_OF_LOBE)
#undef KINDS_OF_LOBE
    };
    uint32_t seen = 0;
    for (size_t i = 0; i < COUNT; i++) {
        double sum = 0;
        for (size_t k = 0; k < LOBE_COUNT; k++) {
            const bool has = kinds[k] >> i % 4 & 1;
            REQUIRE(out[LOBE_COUNT + k][i] == float(has));
            REQUIRE(out[k][i] >= 0);
            if (!has) REQUIRE(out[k][i] == 0);
            seen |= uint32_t(has) << k;
            sum += double(out[k][i]);
        }
        REQUIRE(sum == Approx(1).epsilon(1e-6));
    }
    CHECK(seen == (1u << LOBE_COUNT) - 1);
}
