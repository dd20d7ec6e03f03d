// Each scattering function samples what its pdf and eval say.
#include "support/reference/bsdf.h"
#include "support/reference/microfacet.h"
#include "support/reference/scenes.h"

#include <catch2/catch.hpp>

using namespace onde;
using namespace onde::reference;

namespace {

constexpr glm::vec3 UP{0.0f, 0.0f, 1.0f};

glm::vec3 toward(float cosine) {
    return {safe_sqrt(1.0f - cosine * cosine), 0.0f, cosine};
}

struct Integrals {
    double pdf = 0.0;   ///< or the fraction of samples that are not absorbed
    double value = 0.0; ///< red
};

/// Midpoint rule over the sphere: what is scattered, and the density of all directions.
Integrals by_quadrature(const Bsdf& bsdf) {
    constexpr int ROWS = 1000, COLUMNS = 1000;
    Integrals sum;
    for (int i = 0; i < ROWS; ++i)
        for (int j = 0; j < COLUMNS; ++j) {
            const float z = 1.0f - 2.0f * (float(i) + 0.5f) / ROWS;
            const Scattering s = bsdf.eval(direction_at(z, (float(j) + 0.5f) / COLUMNS));
            sum.pdf += double(s.pdf) * 4.0 * double(PI) / (ROWS * COLUMNS);
            sum.value += double(s.value.r) * 4.0 * double(PI) / (ROWS * COLUMNS);
        }
    return sum;
}

Integrals by_sampling(const Bsdf& bsdf) {
    constexpr uint32_t COUNT = 200000;
    Random random(7, 8, 9);
    Integrals sum;
    for (uint32_t i = 0; i < COUNT; ++i)
        if (const auto s = bsdf.sample(random)) {
            sum.pdf += 1.0 / COUNT;
            sum.value += double(s->weight.r) / COUNT;
        }
    return sum;
}

Material mix(float metallic, float roughness, const glm::vec3& color = {0.8f, 0.6f, 0.3f}) {
    Material m = diffuse(color);
    m.kind = MaterialKind::metallic_roughness;
    m.metallic = metallic;
    m.roughness = roughness;
    return m;
}

struct Energy {
    double mean, deviation;
};
/// What leaves toward the viewer in a white furnace, with refracted radiance in units of its own
/// medium; by samples, since quadrature misses narrow lobes.
Energy energy_of(const Material& material, const Bsdf& bsdf, float cosine) {
    constexpr uint32_t COUNT = 1 << 16;
    const bool is_glass = material.kind == MaterialKind::dielectric;
    const double eta = is_glass ? std::pow(double(material.ior), cosine > 0.0f ? 1.0 : -1.0) : 1.0;
    Random random(4, 5, 6);
    double sum = 0.0, squares = 0.0;
    for (uint32_t i = 0; i < COUNT; ++i)
        if (const auto s = bsdf.sample(random)) {
            const bool through = s->direction.z * cosine < 0.0f;
            const double weight = double(s->weight.r) * (through ? eta * eta : 1.0);
            sum += weight / COUNT;
            squares += weight * weight / COUNT;
        }
    return {sum, std::sqrt(std::max(squares - sum * sum, 0.0) / COUNT)};
}

std::vector<Material> smooth_materials() {
    return {diffuse(glm::vec3(0.8f)),
            conductor(glm::vec3(0.9f), 0.4f),
            conductor(glm::vec3(0.5f), 1.0f),
            mix(0.0f, 0.5f),
            mix(0.6f, 0.4f),
            glass(1.5f, 0.5f),
            glass(1.5f, 0.9f),
            glass(0.7f, 0.6f)};
}

} // namespace

TEST_CASE("samples are distributed as the pdf and weigh as the value says") {
    for (const Material& material : smooth_materials())
        for (const float cosine : {0.95f, 0.4f, -0.3f, -0.9f}) {
            const Bsdf bsdf(MaterialRecord(material), UP, UP, toward(cosine));
            const Integrals area = by_quadrature(bsdf), drawn = by_sampling(bsdf);
            INFO("kind " << int(material.kind) << ", roughness " << material.roughness
                         << ", cosine " << cosine);
            CHECK(drawn.pdf == Approx(area.pdf).margin(0.006));
            CHECK(drawn.value == Approx(area.value).epsilon(0.01).margin(0.004));
            CHECK(area.pdf < 1.006);
        }
}

TEST_CASE("reflection is reciprocal, of metals but for what meets several microfacets") {
    const glm::vec3 a = glm::normalize(glm::vec3(0.3f, 0.5f, 0.6f));
    const glm::vec3 b = glm::normalize(glm::vec3(-0.7f, 0.2f, 0.3f));
    for (const Material& material : smooth_materials()) {
        if (material.kind == MaterialKind::metallic_roughness) continue; // nor are bodies
        const Bsdf from_a(MaterialRecord(material), UP, UP, a);
        const Bsdf from_b(MaterialRecord(material), UP, UP, b);
        const auto compensation = [&](float cosine) {
            if (material.kind != MaterialKind::conductor) return 1.0f;
            const float white = Albedos(reflection_albedos(), material.roughness).at(cosine).x;
            return 1.0f - material.base_color.r + material.base_color.r / white;
        };
        CHECK(from_a.eval(b).value.r / (b.z * compensation(a.z)) ==
              Approx(from_b.eval(a).value.r / (a.z * compensation(b.z))).epsilon(1e-4));
    }
}

TEST_CASE("refraction is reciprocal but for the square of the index") {
    const glm::vec3 a = glm::normalize(glm::vec3(0.3f, 0.1f, 0.8f));
    const glm::vec3 b = glm::normalize(glm::vec3(-0.25f, 0.0f, -0.9f));
    const MaterialRecord material(glass(1.5f, 0.6f));
    const float into = Bsdf(material, UP, UP, a).eval(b).value.r / std::abs(b.z);
    const float out = Bsdf(material, UP, UP, b).eval(a).value.r / std::abs(a.z);
    REQUIRE(into > 0.0f);
    CHECK(into * 1.5f * 1.5f == Approx(out).epsilon(1e-4));
}

TEST_CASE("white surfaces return all light, however rough, from all sides") {
    std::vector<Material> materials;
    for (const float roughness : {0.1f, 0.3f, 0.5f, 0.7f, 0.85f, 1.0f}) {
        materials.push_back(conductor(glm::vec3(1.0f), roughness));
        for (const float metallic : {0.0f, 0.4f, 1.0f})
            materials.push_back(mix(metallic, roughness, glm::vec3(1.0f)));
        for (const float ior : {1.1f, 1.5f, 2.4f, 0.7f}) materials.push_back(glass(ior, roughness));
    }
    for (const Material& material : materials)
        for (const float cosine : {0.99f, 0.7f, 0.4f, 0.2f, 0.1f, -0.1f, -0.3f, -0.8f}) {
            const Bsdf bsdf(MaterialRecord(material), UP, UP, toward(cosine));
            const Energy energy = energy_of(material, bsdf, cosine);
            INFO("kind " << int(material.kind) << ", roughness " << material.roughness << ", index "
                         << material.ior << ", cosine " << cosine);
            CHECK(energy.mean > 0.99 - 4.0 * energy.deviation);
            CHECK(energy.mean < 1.002 + 4.0 * energy.deviation);
        }
}

TEST_CASE("rough gold gains colour, and no more than it gets") {
    const glm::vec3 gold(1.0f, 0.78f, 0.34f);
    const Bsdf rough(MaterialRecord(conductor(gold, 1.0f)), UP, UP, toward(0.9f));
    glm::dvec3 albedo(0.0);
    Random random(3, 3, 3);
    constexpr uint32_t COUNT = 200000;
    for (uint32_t i = 0; i < COUNT; ++i)
        if (const auto s = rough.sample(random)) albedo += glm::dvec3(s->weight) / double(COUNT);
    CHECK(albedo.r == Approx(1.0).margin(0.01));
    CHECK(albedo.g < 0.78);
    // Light that has met n microfacets has the n-th power of their colour.
    CHECK(albedo.b / albedo.g < 0.34 / 0.78 - 0.05);
}

TEST_CASE("smooth glass refracts by Snell's law and reflects by Fresnel's") {
    const Bsdf bsdf(MaterialRecord(glass(1.5f, 0.0f)), UP, UP, toward(0.6f));
    Random random(1, 1, 1);
    double reflected = 0.0;
    constexpr uint32_t COUNT = 100000;
    for (uint32_t i = 0; i < COUNT; ++i) {
        const auto s = bsdf.sample(random);
        REQUIRE((s && s->specular));
        if (s->direction.z > 0.0f)
            reflected += 1.0 / COUNT;
        else
            CHECK(-s->direction.x * 1.5f == Approx(0.8f));
    }
    // r_s = (0.6 - 1.5 c) / (0.6 + 1.5 c), r_p = (0.9 - c) / (0.9 + c), c = sqrt(1 - 0.64 / 2.25).
    const double c = std::sqrt(1.0 - 0.64 / 2.25);
    const double s = (0.6 - 1.5 * c) / (0.6 + 1.5 * c), p = (0.9 - c) / (0.9 + c);
    CHECK(reflected == Approx(0.5 * (s * s + p * p)).margin(0.004));
}

TEST_CASE("nothing crosses an opaque surface by either of its normals") {
    const glm::vec3 shading = glm::normalize(glm::vec3(0.5f, 0.0f, 1.0f));
    const glm::vec3 below = glm::normalize(glm::vec3(0.9f, 0.0f, -0.1f));
    for (const Material& material : {diffuse(glm::vec3(0.8f)), mix(0.5f, 0.6f)}) {
        const Bsdf bsdf(MaterialRecord(material), UP, shading, toward(0.8f));
        REQUIRE(glm::dot(below, shading) > 0.0f);
        CHECK(bsdf.eval(below).value.r == 0.0f);
        Random random(2, 2, 2);
        for (uint32_t i = 0; i < 10000; ++i)
            if (const auto s = bsdf.sample(random)) REQUIRE(s->direction.z > 0.0f);
    }
}

TEST_CASE("the distribution of microfacets projects to one") {
    for (const float alpha : {0.05f, 0.3f, 1.0f}) {
        double sum = 0.0;
        constexpr int STEPS = 100000;
        for (int i = 0; i < STEPS; ++i) {
            const float z = (float(i) + 0.5f) / STEPS;
            sum += double(ggx_distribution(direction_at(z, 0.3f), alpha) * z) * 2.0 * double(PI) /
                   STEPS;
        }
        CHECK(sum == Approx(1.0).epsilon(1e-3));
    }
}
