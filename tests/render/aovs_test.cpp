// What the film holds of first surfaces, and transparent backgrounds.
#include "render/picture.h"
#include "render/variants.h"

#include <cmath>

namespace onde::test {
namespace {

/// A square of 2 x 2 at z = 0 that faces a camera at z = 3, which sees 4 x 4 of that plane.
Scene square_before_sky() {
    Scene scene;
    Mesh mesh;
    mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.materials = {0, 0};
    Material material;
    material.kind = MaterialKind::diffuse;
    material.base_color = {0.2f, 0.4f, 0.6f};
    scene.materials = {material};
    scene.meshes = {mesh};
    scene.instances = {{0, glm::mat4(1)}};
    scene.environment.radiance = glm::vec3(0.5f);
    scene.cameras = {camera_at({0, 0, 3}, {0, 0, 0}, 2 * std::atan(2.0f / 3.0f))};
    return scene;
}

constexpr uint32_t ALL_AOVS = (1u << AOV_COUNT) - 1;

RenderOptions options_with(uint32_t aovs, uint32_t samples = 16) {
    RenderOptions options = small_options(16, 16, samples);
    options.aovs = aovs;
    return options;
}

Session session_of(const Scene& scene, const RenderOptions& options) {
    return Session(programs(), scene, {.render = options, .choose_layout = false});
}

std::vector<float> pixel_of(const Image& image, uint32_t x, uint32_t y) {
    const auto pixel = image.pixel(x, y);
    return {pixel.begin(), pixel.end()};
}

} // namespace

TEST_CASE("AOVs are those of the first surface, and 0 where there is none") {
    Session session = session_of(square_before_sky(), options_with(ALL_AOVS));
    session.render();
    const auto check = [&](const char* name, const std::vector<float>& on_square) {
        INFO(name);
        const Image image = session.film().develop(*find_channel(name));
        const std::vector<float> found = pixel_of(image, 8, 7);
        REQUIRE(found.size() == on_square.size());
        for (size_t k = 0; k < found.size(); k++)
            CHECK(found[k] == Approx(on_square[k]).margin(1e-6));
        for (const float number : pixel_of(image, 1, 14)) CHECK(number == 0.0f);
    };
    check("alpha", {1});
    check("albedo", {0.2f, 0.4f, 0.6f});
    check("normal", {0, 0, 1});
    check("depth", {3});
}

TEST_CASE("AOVs leave the picture as it is, and every engine and split makes the same") {
    const Scene scene = square_before_sky();
    Session plain = session_of(scene, options_with(0, 80));
    plain.render();
    Session first = session_of(scene, options_with(ALL_AOVS, 80)); // more than a block
    first.render();
    CHECK(first_difference(plain.picture(), first.picture()) == "");
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        Session session = session_of(scene, apply(options_with(ALL_AOVS, 80), variant));
        session.render();
        for (const FilmChannel& channel : FILM_CHANNELS) {
            INFO(channel.name);
            CHECK(session.film().develop(channel).pixels == first.film().develop(channel).pixels);
        }
    }
}

TEST_CASE("a film goes on with its AOVs, and refuses another set of them") {
    const Scene scene = square_before_sky();
    Session whole = session_of(scene, options_with(ALL_AOVS, 80));
    whole.render();
    Session begun = session_of(scene, options_with(ALL_AOVS, 16));
    begun.render();
    Session continued = session_of(scene, options_with(ALL_AOVS, 80));
    continued.restore_film(begun.keep_film());
    continued.render();
    const FilmChannel depth = *find_channel("depth");
    CHECK(continued.film().develop(depth).pixels == whole.film().develop(depth).pixels);

    Session fewer = session_of(scene, options_with(1u << AOV_DEPTH));
    CHECK_THROWS_AS(fewer.restore_film(begun.keep_film()), InputError);
    CHECK_THROWS_AS(fewer.film().develop(*find_channel("normal")), InputError);
}

TEST_CASE("a transparent background has alpha for coverage, and nothing of the environment") {
    RenderOptions options = options_with(1u << AOV_ALPHA, 64);
    options.width = options.height = 9; // edges of the square run through pixels
    options.background = Background::transparent;
    Session session = session_of(square_before_sky(), options);
    session.render();
    const Image picture = session.picture();
    REQUIRE(picture.channels == 4);
    double area = 0;
    glm::dvec3 sum(0);
    for (size_t i = 0; i < picture.pixels.size(); i += 4) {
        for (glm::length_t k = 0; k < 3; k++) sum[k] += picture.pixels[i + size_t(k)];
        area += picture.pixels[i + 3];
    }
    // A diffuse square in constant light, of which it sees all there is: albedo x radiance.
    CHECK(sum.x / area == Approx(0.2 * 0.5).epsilon(0.01));
    CHECK(sum.z / area == Approx(0.6 * 0.5).epsilon(0.01));
    CHECK(area / 81 == Approx(0.25).epsilon(0.01)); // of the 4 x 4
}

TEST_CASE("only path tracing has AOVs of surfaces") {
    RenderOptions options = options_with(1u << AOV_DEPTH);
    options.integrator = IntegratorKind::light;
    CHECK_THROWS_AS(check_options(options), InputError);
    options = options_with(0);
    options.background = Background::transparent;
    CHECK_THROWS_AS(check_options(options), InputError); // without alpha
}

} // namespace onde::test
