// BSDFs: samples against densities, weights against values, reciprocity, energy.
#include "doctor/mapped_bsdfs.h"
#include "kernels/bsdf_rig.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::bsdf;

namespace {

constexpr glm::vec3 WHITE(1);

Bsdfs& rough_surfaces() {
    static Bsdfs built = on_device(
        {diffuse(), conductor(0.16f), conductor(0.5f), conductor(1.0f), conductor(0.7f, 0.3f),
         mix(0.16f, 0.0f), mix(0.5f, 0.5f), mix(1.0f, 0.9f), glass(0.2f, 1.5f), glass(0.5f, 1.5f),
         glass(0.8f, 2.0f), glass(0.2f, 1.5f, false), glass(0.5f, 1.5f, false)});
    return built;
}

/// What leaves toward wo in a white furnace, with refracted radiance in units of its own medium.
double albedo(const Surface& surface, const Column& value) {
    const double eta2 = surface.is_glass() ? surface.eta() * surface.eta() : 1.0;
    return integrate(value, [&](glm::vec3 wi) { return wi.z < 0 ? eta2 : 1.0; });
}

} // namespace

TEST_CASE("BSDF samples are distributed as their pdf") {
    constexpr size_t COUNT = 1 << 17;
    const double significance =
        1e-4 / double(rough_surfaces().surfaces().size() * outgoing().size());
    uint32_t seed = 1;
    for (const Surface& surface : rough_surfaces().surfaces())
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            double total = 0;
            CHECK(distribution_failure(quadrature(),
                                       evaluate_sphere(rough_surfaces(), surface, wo).pdf,
                                       sample(rough_surfaces(), surface, wo, COUNT, seed++),
                                       significance, total) == "");
            CHECK(total < 1 + 1e-3);
        }
}

TEST_CASE("the weight of a BSDF sample is value over pdf") {
    constexpr size_t COUNT = 4096;
    for (const Surface& surface : rough_surfaces().surfaces())
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            Samples samples = sample(rough_surfaces(), surface, wo, COUNT, 5);
            const Values values =
                evaluate(rough_surfaces(), surface, std::vector(COUNT, wo), samples.wi);
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

TEST_CASE("opaque values are those of layered microfacets in double precision") {
    constexpr size_t COUNT = 1 << 14;
    Generator generator(2);
    const std::vector<glm::vec3> wo = directions_above(generator, COUNT);
    const std::vector<glm::vec3> wi = directions_above(generator, COUNT);
    for (const Surface& surface : rough_surfaces().surfaces()) {
        if (surface.is_glass()) continue;
        INFO(surface.name);
        const OpaqueValue exact(surface, rough_surfaces().packed().albedos);
        const Columns value = evaluate(rough_surfaces(), surface, wo, wi).value;
        for (uint32_t k = 0; k < 3; k++) {
            const auto wanted = [&](size_t i) {
                return exact(glm::dvec3(wo[i]), glm::dvec3(wi[i]))[k];
            };
            CHECK(worst_ratio(value[k], wanted, 1e-4) == "");
        }
    }
}

TEST_CASE("the diffuse pdf integrates to one, and the diffuse albedo is the colour") {
    const Surface& surface = rough_surfaces().surfaces()[0];
    for (glm::vec3 wo : outgoing()) {
        const Values values = evaluate_sphere(rough_surfaces(), surface, wo);
        CHECK(integrate(values.pdf) == Approx(1).epsilon(1e-5));
        for (uint32_t k = 0; k < 3; k++)
            CHECK(integrate(values.value[k]) ==
                  Approx(surface.material.base_color[k]).epsilon(1e-5));
    }
}

TEST_CASE("diffuse surfaces are reciprocal, metals but for what meets several microfacets") {
    constexpr size_t COUNT = 1 << 14;
    Generator generator(3);
    const std::vector<glm::vec3> a = directions_above(generator, COUNT);
    const std::vector<glm::vec3> b = directions_above(generator, COUNT);
    const std::vector<uint32_t>& table = rough_surfaces().packed().albedos;
    for (const Surface& surface : rough_surfaces().surfaces()) {
        const bool metal = surface.material.kind == MaterialKind::conductor;
        if (!metal && surface.material.kind != MaterialKind::diffuse) continue;
        INFO(surface.name);
        const auto compensation = [&](glm::vec3 wo) {
            const glm::dvec3 f0(metal ? surface.material.base_color : glm::vec3(0));
            const double white = albedo_numbers(table, wo.z, surface.alpha()).first;
            return OpaqueValue::compensation(f0, white).x;
        };
        const Column there = evaluate(rough_surfaces(), surface, a, b).value[0];
        const Column back = evaluate(rough_surfaces(), surface, b, a).value[0];
        Column got(COUNT);
        for (size_t i = 0; i < COUNT; i++)
            got[i] = float(there[i] / b[i].z / compensation(a[i]) * compensation(b[i]));
        CHECK(worst_ratio(
                  got, [&](size_t i) { return back[i] / a[i].z; }, 1e-4) == "");
    }
}

TEST_CASE("of light that comes along wo a surface reflects as much as of light toward it") {
    constexpr size_t COUNT = 1 << 11;
    std::vector<Surface> surfaces = doctor::mixed_surfaces();
    std::erase_if(surfaces, [](const Surface& s) {
        return lobes_of(s.material) >> LOBE_DIELECTRIC & 1; // refraction changes solid angles
    });
    Bsdfs toward = on_device(surfaces);
    Bsdfs along(programs(), surfaces, 1, "adjoint.cl");
    Generator generator(5);
    const std::vector<glm::vec3> wo = directions_above(generator, COUNT);
    std::vector<glm::vec3> wi = directions_above(generator, COUNT), turned_wo = wo, turned_wi = wi;
    for (size_t i = 0; i < COUNT; i += 2) { // behind it; seen from there behind is above
        wi[i].z = -wi[i].z;
        turned_wo[i] = -wo[i];
        turned_wi[i] = -wi[i];
    }
    uint32_t lobes = 0;
    for (const Surface& surface : toward.surfaces()) {
        INFO(surface.name);
        lobes |= lobes_of(surface.material);
        const Values got = evaluate(along, surface, wo, wi);
        CHECK(got.pdf == evaluate(toward, surface, wo, wi).pdf);
        const Columns wanted = evaluate(toward, surface, turned_wi, turned_wo).value;
        for (uint32_t k = 0; k < 3; k++) {
            const auto exchanged = [&](size_t i) {
                return double(wanted[k][i]) / std::abs(wo[i].z) * std::abs(wi[i].z);
            };
            CHECK(worst_ratio(got.value[k], exchanged, 2e-4, 1e-4) == "");
        }
    }
    CHECK(lobes == ((1u << LOBE_COUNT) - 1) - (1u << LOBE_DIELECTRIC));
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
    for (const float ior : {1.5f, 1 / 1.5f, 1.1f})
        for (const float alpha : {0.2f, 0.6f}) {
            INFO("index " << ior << ", alpha " << alpha);
            Bsdfs faces = on_device({glass(alpha, ior), glass(alpha, ior, false)});
            const auto eta = faces.surfaces()[0].eta();
            const Column there = evaluate(faces, faces.surfaces()[0], above, below).value[0];
            const Column back =
                evaluate(faces, faces.surfaces()[1], turned_below, turned_above).value[0];
            const auto wanted = [&](size_t i) { return double(back[i]) / above[i].z; };
            Column got(COUNT);
            size_t lit = 0;
            for (size_t i = 0; i < COUNT; i++) {
                got[i] = float(there[i] / -below[i].z * eta * eta);
                lit += got[i] > 0;
            }
            CHECK(lit > COUNT / 10);
            // Near total reflection 1 - F loses its digits, and its values are small.
            CHECK(worst_ratio(got, wanted, 5e-3, 1e-2) == "");
        }
}

TEST_CASE("a white surface that absorbs nothing returns all light, however rough, from all sides") {
    std::vector<Surface> surfaces;
    for (const float alpha : {0.0f, 0.01f, 0.04f, 0.1f, 0.25f, 0.5f, 0.75f, 1.0f}) {
        surfaces.push_back(conductor(alpha));
        for (const float metallic : {0.0f, 0.4f, 1.0f})
            surfaces.push_back(mix(alpha, metallic, WHITE));
        surfaces.push_back(pane(alpha));
        for (const float metallic : {0.0f, 0.4f})
            for (const bool thin : {false, true}) {
                surfaces.push_back(clear_mix(alpha, metallic, 1.0f, thin));
                surfaces.push_back(clear_mix(alpha, metallic, 0.4f, thin));
            }
        for (const float ior : {1.1f, 1.5f, 2.4f, 0.7f})
            for (const bool front : {true, false}) surfaces.push_back(glass(alpha, ior, front));
    }
    Bsdfs bsdfs = on_device(std::move(surfaces));
    for (const Surface& surface : bsdfs.surfaces())
        for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1}) {
            INFO(surface.name << ", cosine " << cosine);
            const glm::vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
            // By samples, since quadrature misses narrow lobes.
            constexpr size_t COUNT = 1 << 16;
            const Samples samples = sample(bsdfs, surface, wo, COUNT, 9);
            double sum = 0, squares = 0;
            for (size_t i = 0; i < COUNT; i++) {
                const double units = samples.wi[i].z < 0 ? std::pow(surface.eta(), 2) : 1.0;
                const double weight = samples.valid[i] != 0 ? units * samples.weight[i].x : 0;
                sum += weight;
                squares += weight * weight;
            }
            const double mean = sum / COUNT;
            const double deviation =
                std::sqrt(std::max(squares / COUNT - mean * mean, 0.0) / COUNT);
            CHECK(mean > 0.99 - 4 * deviation);
            CHECK(mean < 1 + 1e-5 + 4 * deviation);
        }
}

TEST_CASE("what reflects colour returns no more than it gets") {
    for (const Surface& surface : rough_surfaces().surfaces())
        for (glm::vec3 wo : outgoing()) {
            INFO(surface.name << ", cosine " << wo.z);
            const Values values = evaluate_sphere(rough_surfaces(), surface, wo);
            for (uint32_t k = 0; k < 3; k++) CHECK(albedo(surface, values.value[k]) < 1.005);
        }
}
