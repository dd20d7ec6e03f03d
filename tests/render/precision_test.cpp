// The same scene in other coordinates: far away, huge, tiny, seen from afar, turned often.
#include "render/picture.h"

#include "image/compare.h"

#include <cmath>

namespace onde::test {
namespace {

/// A case of tests/data/precision.
Scene loaded(const std::string& name) {
    return load_scene(std::filesystem::path(ONDE_SOURCE_DIR) / "tests" / "data" / "precision" /
                      name);
}

Image picture_of(const Scene& scene, uint32_t samples = 16) {
    return render_scene(scene, small_options(64, 64, samples)).image;
}

double difference(const Image& a, const Image& b) {
    double sum = 0;
    for (size_t i = 0; i < a.pixels.size(); i++) sum += std::pow(a.pixels[i] - b.pixels[i], 2.0);
    return std::sqrt(sum / double(a.pixels.size()));
}

} // namespace

TEST_CASE("a lens focused at infinity shows what one focused far away does") {
    const Image far = picture_of(loaded("foc10000.toml"));
    CHECK(far.pixels[(32 * 64 + 32) * 3] == Approx(0.4).margin(0.02));
    Scene scene = loaded("foc1e+20.toml");
    CHECK(difference(far, picture_of(scene)) < 1e-3);
    scene.cameras[0].focus_distance = 3e38f;
    CHECK(difference(far, picture_of(scene)) < 1e-3);
    scene.cameras[0].aperture_radius = 0;
    const Image pinhole = picture_of(scene);
    scene.cameras[0].focus_distance = 4;
    CHECK(difference(pinhole, picture_of(scene)) < 1e-3);
}

TEST_CASE("a scene of a billion kilometres looks as one of a metre") {
    const Image small = picture_of(loaded("scale-1.toml"));
    const Scene huge = loaded("scale-1e12.toml");
    CHECK(difference(small, picture_of(huge)) < 1e-3);
    REQUIRE_FALSE(huge.notes.empty());
    CHECK(huge.notes[0].find("too large") != std::string::npos);
}

TEST_CASE("an environment that is turned all the way round is where it was") {
    Scene scene = loaded("scale-1.toml");
    Image map(8, 4, 3);
    for (size_t i = 0; i < map.pixels.size(); i++) map.pixels[i] = float(i % 7) * 0.2f;
    scene.environment.map = map;
    scene.environment.radiance = glm::vec3(1);
    const Image still = picture_of(scene, 4);
    const auto turn = float(2 * std::acos(-1.0));
    for (const float turns : {1.0f, -3.0f}) {
        scene.environment.rotation = turns * turn;
        INFO(turns << " turns");
        CHECK(difference(still, picture_of(scene, 4)) < 2e-3);
    }
}

} // namespace onde::test
