// What is said of scenes that were written for another integrator.
#include "scratch.h"

#include "scene/mapping.h"

using namespace onde;
using onde::test::ScratchFolder;

namespace {

std::vector<std::string> notes(const std::string& toml, IntegratorKind integrator) {
    const ScratchFolder folder;
    return mapping_notes(load_scene(folder.write("a.toml", toml)), integrator);
}

const std::string SPHERE = "[[shape]]\ntype = \"sphere\"\nmaterial = \"m\"\n";

const std::string CHAPTER = SPHERE + R"(
[[light]]
type = "point"
position = [0, 5, 0]
chapter_intensity = 1
[[material]]
name = "m"
kind = "phong"
transmission = 0.9
[[material]]
name = "n"
kind = "phong"
[whitted]
ambient = 0.1
)";

const std::string PHYSICAL = SPHERE + R"(
[camera]
position = [0, 0, 5]
look_at = [0, 0, 0]
aperture = 0.1
[[light]]
type = "rectangle"
corner = [0, 3, 0]
edge1 = [1, 0, 0]
edge2 = [0, 0, 1]
radiance = 4
[[material]]
name = "m"
kind = "conductor"
[[material]]
name = "glow"
emission = 2
)";

} // namespace

TEST_CASE("a scene that is an integrator's own needs no words") {
    CHECK(notes(CHAPTER, IntegratorKind::whitted).empty());
    CHECK(notes(PHYSICAL, IntegratorKind::path).empty());
    CHECK(notes(PHYSICAL, IntegratorKind::light).empty());
    CHECK(notes(SPHERE + "[[material]]\nname = \"m\"\n[environment]\n", IntegratorKind::painter)
              .empty());
}

TEST_CASE("path and light tracing say how they take the chapter's materials and lights") {
    for (const IntegratorKind kind : {IntegratorKind::path, IntegratorKind::light}) {
        const auto said = notes(CHAPTER, kind);
        REQUIRE(said.size() == 3);
        CHECK_THAT(said[0], Catch::Contains("1 diffuse, 1 dielectric"));
        CHECK_THAT(said[1], Catch::StartsWith("1 lights have only the chapter's intensity"));
        CHECK_THAT(said[2], Catch::Contains("[whitted] were left out"));
    }
}

TEST_CASE("Whitted says how it takes physical materials, lights, glow and lenses") {
    const auto said = notes(PHYSICAL, IntegratorKind::whitted);
    REQUIRE(said.size() == 4);
    CHECK_THAT(said[0], Catch::Contains("1 conductor"));
    CHECK_THAT(said[1], Catch::StartsWith("1 lights have only a power"));
    CHECK_THAT(said[2], Catch::StartsWith("1 glowing materials"));
    CHECK_THAT(said[3], Catch::Contains("pinhole"));
}

TEST_CASE("depth buffer and painter say that they leave out light, mirrors, glass and lenses") {
    for (const IntegratorKind kind : {IntegratorKind::depth_buffer, IntegratorKind::painter}) {
        const auto physical = notes(PHYSICAL, kind);
        REQUIRE(physical.size() == 2);
        CHECK_THAT(physical[0], Catch::Contains("1 lights, glow, reflection and refraction"));
        CHECK_THAT(physical[1], Catch::Contains("parallel"));
        CHECK_THAT(notes(CHAPTER, kind).at(0), Catch::Contains("refraction"));
    }
}
