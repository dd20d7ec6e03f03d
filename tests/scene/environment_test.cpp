// Pictures as environments: what is no radiance in them.
#include "scratch.h"

#include <cmath>
#include <limits>

using namespace onde;
using onde::test::bytes_of;
using onde::test::ScratchFolder;

namespace {

constexpr float INF = std::numeric_limits<float>::infinity();
constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();

/// A sphere under a PFM of one row of these grey pixels.
Scene load_under(std::initializer_list<float> row) {
    const ScratchFolder folder;
    folder.write("sky.pfm", "Pf\n" + std::to_string(row.size()) + " 1\n-1.0\n" + bytes_of(row));
    return load_scene(
        folder.write("a.toml", "[[shape]]\ntype = \"sphere\"\n[environment]\nmap = \"sky.pfm\"\n"));
}

/// The red of each pixel.
std::vector<float> reds(const Scene& scene) {
    std::vector<float> values;
    for (size_t i = 0; i < scene.environment.map->pixels.size(); i += 3)
        values.push_back(scene.environment.map->pixels[i]);
    return values;
}

} // namespace

TEST_CASE("an infinite sun becomes the largest number of its picture, and a note says so") {
    const Scene dim = load_under({0.5f, INF, 2});
    CHECK(reds(dim) == std::vector<float>{0.5f, 65504, 2});
    REQUIRE(dim.notes.size() == 2); // the other is on the camera
    CHECK_THAT(dim.notes.front() + dim.notes.back(), Catch::Contains("3 infinite numbers"));
    CHECK(reds(load_under({1e6f, INF})) == std::vector<float>{1e6f, 1e6f});
}

TEST_CASE("negative pixels and what is no number become black, without a note") {
    const Scene scene = load_under({-1, NOT_A_NUMBER, -INF, 3});
    CHECK(reds(scene) == std::vector<float>{0, 0, 0, 3});
    for (const std::string& note : scene.notes) CHECK(note.find("infinite") == std::string::npos);
}

TEST_CASE("an environment may be turned by any number of degrees") {
    const auto rotation = [](const std::string& degrees) {
        const ScratchFolder folder;
        return load_scene(folder.write("a.toml", "[[shape]]\ntype = \"sphere\"\n[environment]\n"
                                                 "radiance = 1\nrotation = " +
                                                     degrees))
            .environment.rotation;
    };
    CHECK(rotation("3600090") == Approx(1.57079633f));
    CHECK(rotation("-3600090") == Approx(-1.57079633f));
    CHECK(std::abs(rotation("1e38")) < 3.1416f);
}
