// What the film holds of first surfaces, and transparent backgrounds.
#include "render/picture.h"
#include "render/variants.h"

#include <algorithm>
#include <cmath>
#include <memory>

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
    if (aovs >> AOV_CLAMPED & 1) options.clamp = 1e6f; // none is cut off
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
    Scene scene = square_before_sky();
    scene.meshes[0].uvs = {{0, 0}, {0.5f, 0}, {0.5f, 0.25f}, {0, 0.25f}};
    Session session = session_of(scene, options_with(ALL_AOVS, 256));
    session.render();
    const auto check = [&](const char* name, const std::vector<float>& on_square) {
        INFO(name);
        const Image image = session.film().develop(*find_channel(name));
        const std::vector<float> found = pixel_of(image, 8, 7);
        REQUIRE(found.size() == on_square.size());
        for (size_t k = 0; k < found.size(); k++)
            CHECK(found[k] == Approx(on_square[k]).margin(1e-3));
        for (const float number : pixel_of(image, 1, 14)) CHECK(number == 0.0f);
    };
    check("alpha", {1});
    check("albedo", {0.2f, 0.4f, 0.6f});
    check("normal", {0, 0, 1});
    check("depth", {3});
    check("position", {0.125f, 0.125f, 0}); // the middle of the pixel, 1/4 wide
    check("uv", {0.5f * 0.5625f, 0.25f * 0.5625f});
}

TEST_CASE("the variance is that of the picture over seeds") {
    Scene scene = square_before_sky();
    scene.point_lights = {{.position = {0.5f, 0.2f, 0.4f}, .intensity = glm::vec3(2)},
                          {.position = {-0.5f, 0.8f, 0.6f}, .intensity = glm::vec3(1)}};
    const auto render = [&](uint32_t seed) {
        RenderOptions options = options_with(1u << AOV_SQUARES, 1);
        options.seed = seed;
        return session_of(scene, options);
    };
    constexpr uint32_t SEEDS = 64; // of one sample each, which are independent
    double sum = 0, squares = 0;
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        Session session = render(seed);
        session.render();
        const double found = session.picture().pixel(8, 7)[1];
        const Image variance = session.film().develop(*find_channel("variance"));
        CHECK(variance.pixel(8, 7)[1] == Approx(found * found)); // of one sample: its square
        sum += found;
        squares += found * found;
    }
    const double of_sample = (squares - sum * sum / SEEDS) / (SEEDS - 1);
    RenderOptions options = options_with(1u << AOV_SQUARES, 128);
    Session session = session_of(scene, options);
    session.render();
    const Image variance = session.film().develop(*find_channel("variance"));
    // Two variances of 64 and 128 samples: each has a relative spread of about sqrt(2 / n) or less.
    CHECK(variance.pixel(8, 7)[1] * 128 == Approx(of_sample).epsilon(0.6));
    CHECK(variance.pixel(8, 7)[1] > 0);
}

namespace {

/// A glossy floor under a lamp, a mirror that shows it, a ball of glass, and light of the sky.
Scene scene_of_all_lights() {
    Scene scene = square_before_sky();
    Material glass;
    glass.kind = MaterialKind::dielectric;
    glass.base_color = {0.9f, 1, 0.9f};
    glass.ior = 1.5f;
    glass.roughness = 0;
    Material mirror;
    mirror.kind = MaterialKind::conductor;
    mirror.base_color = {0.8f, 0.7f, 0.6f};
    mirror.roughness = 0;
    Material mix;
    mix.kind = MaterialKind::metallic_roughness;
    mix.base_color = {0.7f, 0.3f, 0.2f};
    mix.roughness = 0.5f;
    mix.metallic = 0.3f;
    Material lamp;
    lamp.kind = MaterialKind::diffuse;
    lamp.base_color = glm::vec3(0);
    lamp.emission = glm::vec3(6, 5, 4);
    scene.materials = {mix, glass, mirror, lamp};
    scene.spheres = {{{0.5f, -0.3f, 0.5f}, 0.3f, 1},
                     {{-0.5f, -0.4f, 0.5f}, 0.3f, 2},
                     {{0, 0.7f, 0.5f}, 0.1f, 3}};
    return scene;
}

Image sum_of(Session& session, const std::vector<const char*>& names) {
    Image sum = session.film().develop(*find_channel(names[0]));
    for (size_t i = 1; i < names.size(); i++) {
        const Image next = session.film().develop(*find_channel(names[i]));
        for (size_t k = 0; k < sum.pixels.size(); k++) sum.pixels[k] += next.pixels[k];
    }
    return sum;
}

} // namespace

TEST_CASE("shares of light add up to the picture") {
    Session session = session_of(scene_of_all_lights(), options_with(ALL_AOVS, 64));
    session.render();
    const Image picture = session.film().develop();
    const auto check = [&](const std::vector<const char*>& names) {
        const Image sum = sum_of(session, names);
        for (size_t i = 0; i < sum.pixels.size(); i++) {
            INFO(names[1] << " " << i);
            CHECK(sum.pixels[i] == Approx(picture.pixels[i]).epsilon(2e-5).margin(1e-6));
        }
    };
    check({"emission", "direct", "indirect"});
    check({"emission", "diffuse", "glossy", "transmitted"});
    for (const char* name :
         {"emission", "direct", "indirect", "diffuse", "glossy", "transmitted"}) {
        INFO(name);
        const Image image = session.film().develop(*find_channel(name));
        CHECK(std::ranges::max(image.pixels) > 0);
        CHECK(std::ranges::min(image.pixels) >= 0);
    }
}

TEST_CASE("a clamp cuts samples off, keeps what it cuts, and its shares of light add up") {
    const Scene scene = scene_of_all_lights();
    const auto render = [&](float clamp, const Variant& variant) {
        RenderOptions options = options_with(clamp > 0 ? ALL_AOVS : 0, 64);
        options.clamp = clamp;
        auto session = std::make_unique<Session>(programs(), scene,
                                                 SessionOptions{.render = apply(options, variant)});
        session->render();
        return session;
    };
    const auto plain = render(0, VARIANTS[0]);
    CHECK(plain->clamped_share() == 0);
    const Image all = plain->picture();
    const auto clamped = render(1.5f, VARIANTS[0]);
    const Image picture = clamped->film().develop();
    const Image lost = clamped->film().develop(*find_channel("clamped"));
    const Image shares = sum_of(*clamped, {"emission", "diffuse", "glossy", "transmitted"});
    CHECK(std::ranges::max(all.pixels) > 1.5f);
    CHECK(std::ranges::max(picture.pixels) <= 1.5f * 1.00001f);
    double light = 0, cut = 0;
    for (size_t i = 0; i < all.pixels.size(); i++) {
        CHECK(picture.pixels[i] + lost.pixels[i] ==
              Approx(all.pixels[i]).epsilon(1e-5).margin(1e-6));
        CHECK(shares.pixels[i] == Approx(picture.pixels[i]).epsilon(2e-5).margin(1e-6));
        light += all.pixels[i];
        cut += lost.pixels[i];
    }
    CHECK(clamped->clamped_share() == Approx(cut / light).epsilon(1e-4));
    CHECK(cut > 0);
    for (const Variant& variant : VARIANTS) {
        INFO(variant.name);
        const auto other = render(1.5f, variant);
        CHECK(other->film().develop().pixels == picture.pixels);
        CHECK(other->film().develop(*find_channel("clamped")).pixels == lost.pixels);
    }
}

TEST_CASE("a diffuse surface reflects diffuse light, a mirror glossy, glass both sides") {
    Scene scene = square_before_sky();
    Material& material = scene.materials[0];
    RenderOptions options = options_with(ALL_AOVS, 256);
    const auto brightness = [&](const char* name) {
        Session session = session_of(scene, options);
        session.render();
        return session.film().develop(*find_channel(name)).pixel(8, 7)[0];
    };
    CHECK(brightness("diffuse") == Approx(0.2 * 0.5).epsilon(0.01));
    CHECK(brightness("glossy") == 0);
    CHECK(brightness("emission") == 0);
    CHECK(brightness("direct") == Approx(0.2 * 0.5).epsilon(0.01));
    material.kind = MaterialKind::conductor;
    material.roughness = 0;
    CHECK(brightness("glossy") == Approx(0.2 * 0.5).epsilon(0.01));
    CHECK(brightness("diffuse") == 0);
    material.kind = MaterialKind::dielectric;
    material.base_color = glm::vec3(1);
    material.ior = 1.5f;
    options.samples = 1024;
    CHECK(brightness("glossy") == Approx(0.04 * 0.5).epsilon(0.1));
    CHECK(brightness("transmitted") == Approx(0.96 * 0.5 / 2.25).epsilon(0.02)); // within glass
}

TEST_CASE("guides are those of what mirrors and clear glass show, tinted") {
    Scene scene = square_before_sky();
    Material mirror;
    mirror.kind = MaterialKind::conductor;
    mirror.roughness = 0;
    mirror.base_color = {0.5f, 1, 1};
    scene.materials.push_back(mirror);
    // The camera looks down at a mirror that stands at 45 degrees, which shows the square.
    Mesh tilted = scene.meshes[0];
    tilted.positions = {{-9, 1, -1}, {9, 1, -1}, {9, 3, 1}, {-9, 3, 1}};
    tilted.materials = {1, 1};
    scene.meshes.push_back(tilted);
    scene.meshes[0].positions = {{-9, 0, -9}, {9, 0, -9}, {9, 0, 9}, {-9, 0, 9}};
    scene.instances.push_back({1, glm::mat4(1)});
    scene.cameras = {camera_at({0, 2, 3}, {0, 2, 0}, 0.2f)};
    Session session = session_of(scene, options_with(ALL_AOVS));
    session.render();
    const auto check = [&](const char* name, const std::vector<float>& expected) {
        INFO(name);
        const std::vector<float> found =
            pixel_of(session.film().develop(*find_channel(name)), 8, 7);
        for (size_t k = 0; k < found.size(); k++)
            CHECK(found[k] == Approx(expected[k]).margin(1e-3));
    };
    check("albedo", {0.5f, 1, 1});
    check("denoise-albedo", {0.1f, 0.4f, 0.6f});
    check("denoise-normal", {0, 1, 0});
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
