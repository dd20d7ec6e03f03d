// What measured surfaces have beside glTF's: metals' edges, and coats that send light back.
#include "kernels/bsdf_rig.h"
#include "scene/measured.h"

using namespace onde;
using namespace onde::test;
using namespace onde::test::bsdf;

namespace {

double schlick(double f0, double cosine) {
    return f0 + (1 - f0) * std::pow(1 - cosine, 5);
}

} // namespace

TEST_CASE("a metal's tint shows at its edge, and not where one looks at it head on") {
    Surface metal = conductor(0, 0.6f);
    metal.material.edge_tint = {0.5f, 0.9f, 1.0f};
    Surface half = bsdf::mix(0, 0.5f, glm::vec3(0.6f));
    half.material.edge_tint = metal.material.edge_tint;
    Bsdfs bsdfs = on_device({metal, half});
    for (const double cosine : {1.0, 0.6, 1.0 / 7, 0.05}) {
        INFO("cosine " << cosine);
        const glm::vec3 wo(std::sqrt(1 - cosine * cosine), 0, cosine);
        const glm::vec3 weight = sample(bsdfs, bsdfs.surfaces()[0], wo, 16, 1).weight[0];
        for (glm::length_t c = 0; c < 3; c++) {
            const double edge = 1.0 / 7;
            const double less = schlick(double(0.6f), edge) *
                                (1 - double(metal.material.edge_tint[c])) /
                                (edge * std::pow(1 - edge, 6));
            const double wanted =
                schlick(double(0.6f), cosine) - less * cosine * std::pow(1 - cosine, 6);
            CHECK(weight[c] == Approx(wanted).epsilon(1e-5));
        }
    }
    // Of a mix only the metal has it.
    const double edge = 1.0 / 7;
    const glm::vec3 wo(std::sqrt(1 - edge * edge), 0, edge);
    const Samples samples = sample(bsdfs, bsdfs.surfaces()[1], wo, 4096, 1);
    for (size_t i = 0; i < samples.weight.size(); i++) {
        if (samples.delta[i] == 0) continue;
        const double coat = 0.5 * schlick(0.04, edge), metallic = 0.5 * schlick(double(0.6f), edge);
        CHECK(samples.weight[i].x / samples.weight[i].z ==
              Approx((coat + 0.5 * metallic) / (coat + metallic)).epsilon(1e-4));
        return;
    }
    FAIL("no sample was mirrored");
}

TEST_CASE("a coat that sends light back makes colours deeper, but for black and white") {
    const glm::vec3 color(0.0f, 0.5f, 1.0f);
    Surface plain = bsdf::mix(0, 0, color), plastic = plain;
    plastic.material.inner_reflection = 0.6f;
    Bsdfs bsdfs = on_device({plain, plastic});
    const std::vector<glm::vec3> wo{{0.6f, 0, 0.8f}}, wi{{-0.36f, 0.48f, 0.8f}};
    const Columns without = evaluate(bsdfs, bsdfs.surfaces()[0], wo, wi).value;
    const Columns with = evaluate(bsdfs, bsdfs.surfaces()[1], wo, wi).value;
    // Through the coat both ways, as Fresnel says; 0.0918 is what it reflects of diffuse light.
    const double left = 1 - conductor_reflectance(0.8, 1.5, 0);
    const double once = left / (1 - schlick(0.04, 0.8)), entered = left / (1 - 0.0918);
    for (uint32_t c = 0; c < 3; c++)
        CHECK(with[c][0] == Approx(without[c][0] * once * entered * 0.4 /
                                   (1 - 0.6 * double(color[glm::length_t(c)])))
                                .epsilon(0.004));
    CHECK(without[1][0] > 0.1f);
}

TEST_CASE("plastics are the same both ways, and white ones return all light") {
    std::vector<Surface> surfaces;
    for (const float alpha : {0.0f, 0.01f, 0.05f, 0.1f, 0.4f, 1.0f}) {
        surfaces.push_back(bsdf::mix(alpha, 0, glm::vec3(1)));
        surfaces.back().material.inner_reflection = alpha == 0.1f ? 0.0f : 0.6f;
    }
    Bsdfs bsdfs = on_device(std::move(surfaces));
    Generator generator(5);
    const std::vector<glm::vec3> some = directions_above(generator, 4096);
    const std::vector<glm::vec3> others = directions_above(generator, 4096);
    const Surface& smooth = bsdfs.surfaces()[0]; // whose values are of the body alone
    const Column there = evaluate(bsdfs, smooth, some, others).value[0];
    const Column back = evaluate(bsdfs, smooth, others, some).value[0];
    const auto wanted = [&](size_t i) {
        return double(back[i]) * double(others[i].z) / double(some[i].z);
    };
    CHECK(worst_ratio(there, wanted, 1e-4, 1e-6) == "");
    for (const Surface& surface : bsdfs.surfaces())
        for (const double cosine : {1.0, 0.6, 0.25, 0.1}) {
            INFO(surface.name << ", cosine " << cosine);
            const MeanWeight mean =
                mean_weight(surface, sample(bsdfs, surface, direction(cosine, 0), 1 << 16, 9));
            CHECK(mean.value.x > 0.99 - 4 * mean.deviation.x);
            CHECK(mean.value.x < 1 + 1e-3 + 4 * mean.deviation.x);
        }
}

TEST_CASE("white bodies under fibres and under films return all light, in every colour") {
    std::vector<Surface> surfaces;
    for (const float roughness : {0.0f, 0.1f, 0.2f, 0.5f, 1.0f}) {
        Surface fibres = bsdf::mix(0.25f, 0, glm::vec3(1));
        fibres.name += fmt::format(", sheen {}", roughness);
        fibres.material.sheen_color = glm::vec3(1);
        fibres.material.sheen_roughness = roughness;
        surfaces.push_back(fibres);
    }
    for (const float thickness : {0.0f, 300.0f, 400.0f, 700.0f})
        for (const float ior : {1.3f, 1.8f}) {
            Surface film = bsdf::mix(0, 0, glm::vec3(1));
            film.name += fmt::format(", film {} {}", thickness, ior);
            film.material.iridescence = 1;
            film.material.iridescence_ior = ior;
            film.material.iridescence_thickness = thickness;
            surfaces.push_back(film);
        }
    Bsdfs bsdfs = on_device(std::move(surfaces));
    for (const Surface& surface : bsdfs.surfaces())
        for (const double cosine : {1.0, 0.7, 0.4, 0.2, 0.1}) {
            INFO(surface.name << ", cosine " << cosine);
            const MeanWeight mean =
                mean_weight(surface, sample(bsdfs, surface, direction(cosine, 0), 1 << 15, 9));
            for (glm::length_t c = 0; c < 3; c++) {
                CHECK(mean.value[c] > 0.99 - 4 * mean.deviation[c]);
                CHECK(mean.value[c] < 1 + 1e-4 + 4 * mean.deviation[c]);
            }
        }
}

TEST_CASE("what textures alone make specular is compiled") {
    Material m;
    m.kind = MaterialKind::metallic_roughness;
    CHECK_FALSE(features_of(m).specular);
    m.specular_texture = 0;
    CHECK(features_of(m).specular);
    m.specular_texture = NO_TEXTURE;
    m.specular_color_texture = 0;
    CHECK(features_of(m).specular);
}
