// Glass that bends light of each wavelength its own way.
#include "render/same_bits.h"
#include "shared/spectrum.h"
#include "upload/spectrum_table.h"

#include <glm/gtc/matrix_transform.hpp>

namespace onde::test {
namespace {

Material prism(float ior, float dispersion) {
    Material glass = doctor::furnace_material(MaterialKind::dielectric, glm::vec3(1), 0);
    glass.ior = ior;
    glass.dispersion = dispersion;
    return glass;
}

double index_of(const Material& m, double bend) {
    return double(m.ior) + (double(m.ior) - 1) * double(m.dispersion) / 20 * bend;
}

double reflected(double cosine, double ior) {
    const double in = std::sqrt(1 - (1 - cosine * cosine) / (ior * ior));
    const double p = (ior * cosine - in) / (ior * cosine + in);
    const double s = (cosine - ior * in) / (cosine + ior * in);
    return 0.5 * (p * p + s * s);
}

/// By channel, the mean over the spectrum of part(bend).
template <class Part>
glm::dvec3 over_spectrum(const Part& part) {
    const std::vector<SpectrumKnot> knots = spectrum_table();
    glm::dvec3 sum(0);
    constexpr int STEPS = 8;
    for (size_t k = 0; k + 1 < knots.size(); k++)
        for (int i = 0; i < STEPS; i++) {
            const double t = (i + 0.5) / STEPS, share = 1.0 / STEPS / double(knots.size() - 1);
            const double value = part(std::lerp(knots[k].bend, knots[k + 1].bend, t));
            for (int c = 0; c < 3; c++)
                sum[c] += share * value * std::lerp(knots[k].color[c], knots[k + 1].color[c], t);
        }
    return sum;
}

/// The mean of each channel, and its standard error by pixels.
struct Means {
    glm::dvec3 mean{0}, error{0};
    explicit Means(const Image& image) {
        const size_t count = image.pixels.size() / image.channels;
        for (int c = 0; c < 3; c++) {
            double sum = 0, squares = 0;
            for (size_t i = 0; i < count; i++) {
                const double value = image.pixels[i * image.channels + size_t(c)];
                sum += value;
                squares += value * value;
            }
            mean[c] = sum / double(count);
            error[c] = std::sqrt((squares / double(count) - mean[c] * mean[c]) / double(count));
        }
    }
};

} // namespace

TEST_CASE("the spectrum is white, and goes from what bends most to what bends least") {
    const glm::dvec3 white = over_spectrum([](double) { return 1.0; });
    for (int c = 0; c < 3; c++) CHECK(white[c] == Approx(1).epsilon(1e-6));
    const std::vector<SpectrumKnot> knots = spectrum_table();
    REQUIRE(knots.size() == SPECTRUM_KNOTS);
    for (size_t k = 0; k < knots.size(); k++) {
        INFO("knot " << k);
        CHECK((k == 0 || knots[k].bend < knots[k - 1].bend));
        const float* c = knots[k].color;
        CHECK(c[0] + c[1] + c[2] == Approx(3).epsilon(0.02));
        CHECK(std::min({c[0], c[1], c[2]}) >= 0);
    }
    const auto bend = [](double part) { return part; };
    const glm::dvec3 mean = over_spectrum(bend);
    CHECK(mean.b > mean.g + 0.3);
    CHECK(mean.g > mean.r + 0.1);
}

TEST_CASE("glass that disperses takes no light from a white world, nor gives it colour") {
    const auto seen = [](float roughness) {
        Material glass = prism(1.6f, 3);
        glass.roughness = roughness;
        RenderOptions options = small_options(32, 32, 256);
        options.depth = 64;
        return Means(render_scene(doctor::furnace(glass), options).image);
    };
    for (const float roughness : {0.0f, 0.4f}) {
        const Means means = seen(roughness);
        INFO(roughness << ": " << means.mean.r << " " << means.mean.g << " " << means.mean.b);
        for (int c = 0; c < 3; c++)
            CHECK(std::abs(means.mean[c] - (roughness > 0 ? 0.997 : 1.0)) <
                  (roughness > 0 ? 0.004 : 1e-3) + 4 * means.error[c]);
    }
}

TEST_CASE("a slanted slab shifts what lies behind it, each wavelength by Snell's law") {
    // An edge of light at x = 0, seen by parallel rays through a slab of 1, turned by 50 degrees.
    const Material glass = prism(1.6f, 4);
    const double angle = glm::radians(50.0), sine = std::sin(angle), cosine = std::cos(angle);
    Scene scene;
    scene.materials = {glass, doctor::furnace_material(MaterialKind::diffuse, glm::vec3(0), 1)};
    scene.materials[1].emission = glm::vec3(1);
    scene.meshes = {box_mesh(glm::vec3(40, 40, 1), 0), Mesh{}};
    Mesh& light = scene.meshes[1];
    light.positions = {{0, -9, -30}, {20, -9, -30}, {20, 9, -30}, {0, 9, -30}};
    light.triangles = {{0, 1, 2}, {0, 2, 3}};
    light.materials = {1, 1};
    scene.instances = {{0, glm::rotate(glm::mat4(1.0f), float(angle), glm::vec3(0, 1, 0))},
                       {1, glm::mat4(1.0f)}};
    scene.cameras = {camera_at({0, 0, 60}, {0, 0, 0}, 0.1f)};
    scene.cameras[0].orthographic_height = 2.0f;
    RenderOptions options = small_options(64, 64, 256);
    options.depth = 3; // what the slab reflects inside comes later
    const Means seen(render_scene(scene, options).image);

    const glm::dvec3 wanted = over_spectrum([&](double bend) {
        const double n = index_of(glass, bend), inside = std::sqrt(n * n - sine * sine);
        const double shift = sine * (1 - cosine / inside);
        const double split =
            (1 - reflected(cosine, double(glass.ior))) * (1 - reflected(cosine, n));
        return split * (0.5 - 0.5 * shift);
    });
    for (int c = 0; c < 3; c++) {
        INFO("channel " << c << ": " << seen.mean[c] << ", wanted " << wanted[c]);
        CHECK(std::abs(seen.mean[c] - wanted[c]) < 2e-3 + 4 * seen.error[c] / 16);
    }
    CHECK(std::abs(seen.mean.b - seen.mean.r) > 5e-3);
}

TEST_CASE("light that disperses has the same bits in all engines and lanes") {
    Scene scene = doctor::furnace(prism(1.7f, 5));
    scene.environment.map.emplace(4, 2, 3);
    for (size_t i = 0; i < scene.environment.map->pixels.size(); i++)
        scene.environment.map->pixels[i] = 0.1f + 0.3f * float(i % 7);
    RenderOptions options = small_options(16, 16, 4);
    check_same_bits(scene, options);
}

} // namespace onde::test
