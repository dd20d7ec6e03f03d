// How things move: keys between places, and what files of each format say of motion.
#include "scene/load.h"
#include "scene/scratch.h"
#include "scene/shutter.h"
#include "support/folders.h"

#include <catch2/catch.hpp>
#include <fmt/format.h>
#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

using namespace onde;
using namespace onde::test;

namespace {

glm::mat4 turned(double angle) {
    return glm::mat4(glm::rotate(glm::dmat4(1), angle, glm::dvec3(0, 0, 1)));
}

glm::vec3 place_of(const glm::mat4& m) {
    return glm::vec3(m[3]);
}

/// The matrix that kernels mix of the keys.
glm::mat4 mixed(const MotionKeys& keys, double time) {
    const double at = time * double(keys.size() - 1);
    const auto step = std::min(size_t(at), keys.size() - 2);
    const auto share = float(at - double(step));
    return keys[step] * (1 - share) + keys[step + 1] * share;
}

Scene load_moving(const std::filesystem::path& path, double seconds,
                  std::optional<double> at = {}) {
    LoadOptions options;
    options.at = at;
    Scene scene = load_scene(path, options);
    load_shutter(scene, path, options, seconds);
    return scene;
}

const std::string CAMERA = "[[camera]]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\n";

} // namespace

TEST_CASE("what stands still has no keys, and straight ways have two") {
    CHECK(motion_keys({turned(1), turned(1), turned(1)}).empty());
    const glm::mat4 there = glm::translate(glm::mat4(1), glm::vec3(1, 2, 3));
    CHECK(motion_keys({glm::mat4(1), there}) == MotionKeys{glm::mat4(1), there});
}

TEST_CASE("mixed keys turn points on circles that are flatter by no more than is stated") {
    for (const double angle : {0.1, 1.0, 3.0}) {
        const MotionKeys keys = motion_keys({turned(0), turned(angle)});
        INFO(angle << ": " << keys.size());
        for (int i = 0; i <= 1000; i++) {
            const double time = i / 1000.0;
            const glm::vec3 p(mixed(keys, time) * glm::vec4(1, 0, 0, 1));
            const double radius = glm::length(glm::dvec2(p.x, p.y));
            REQUIRE(radius <= 1 + 1e-6);
            REQUIRE(radius >= 1 - 2.01e-4);
            REQUIRE(std::abs(std::atan2(p.y, p.x) - angle * time) < 1e-4);
        }
    }
}

TEST_CASE("between two places things move straight, turn evenly and stretch linearly") {
    const glm::dmat4 from = glm::scale(glm::dmat4(1), glm::dvec3(1, 2, -1)); // a mirror image too
    const glm::dmat4 to = glm::scale(
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(4, 0, 0)), 1.2, glm::dvec3(0, 1, 0)),
        glm::dvec3(3, 2, -1));
    const glm::dmat4 half = between(from, to, 0.5);
    const glm::dmat4 expected = glm::scale(
        glm::rotate(glm::translate(glm::dmat4(1), glm::dvec3(2, 0, 0)), 0.6, glm::dvec3(0, 1, 0)),
        glm::dvec3(2, 2, -1));
    for (glm::length_t i = 0; i < 4; i++) CHECK(glm::length(half[i] - expected[i]) < 1e-9);
}

TEST_CASE("TOML moves shapes, included files and cameras, and is seen at any second") {
    const ScratchFolder scratch;
    scratch.write("part.toml", "[[shape]]\ntype = \"box\"\n");
    const auto path = scratch.write("scene.toml", CAMERA + R"(motion = [
  { time = 1, position = [0, 0, 5] }, { time = 2, position = [2, 0, 5], look_at = [2, 0, 0] }]
[[shape]]
type = "box"
name = "box"
position = [1, 0, 0]
motion = [{ time = 1, rotation = 0 }, { time = 2, position = [1, 4, 0], rotation = [0, 0, 360] }]
[[shape]]
type = "sphere"
center = [0, 1, 0]
motion = [{ time = 1, center = [0, 1, 0] }, { time = 3, center = [0, 3, 0] }]
[[shape]]
type = "torus"
[[include]]
file = "part.toml"
position = [0, -2, 0]
motion = [{ time = 0, position = [0, -2, 0] }, { time = 10, position = [0, -2, 10] }]
)");
    const Scene still = load_scene(path);
    REQUIRE(still.instances.size() == 2);
    CHECK(place_of(still.instances[0].object_to_world) == glm::vec3(1, 4, 0)); // its only position
    LoadOptions options;
    options.at = 1.5;
    const Scene half = load_scene(path, options);
    CHECK(half.moment == 1.5);
    CHECK(half.spheres.at(0).center == glm::vec3(0, 1.5f, 0));
    CHECK(glm::length(place_of(half.instances[1].object_to_world) - glm::vec3(0, -2, 1.5f)) < 1e-6);
    CHECK(glm::length(place_of(half.cameras[0].camera_to_world) - glm::vec3(1, 0, 5)) < 1e-6);
    CHECK(half.instances[0].object_to_world[0].x == Approx(-1)); // half a turn

    const Scene blurred = load_moving(path, 0.25, 1.0);
    REQUIRE(blurred.shutter);
    const ShutterMotion& motion = *blurred.shutter;
    CHECK(motion.instances.at(0).size() > 40); // a quarter of a turn
    CHECK(motion.instances.at(1).size() == 2); // a straight way, however many moments are asked
    CHECK(blurred.spheres.empty());            // it is a shape now
    REQUIRE(motion.shapes.size() == 2);
    CHECK(motion.shapes[0].empty());
    CHECK(glm::length(place_of(motion.shapes[1].back()) - glm::vec3(0, 1.25f, 0)) < 1e-6);
    CHECK(place_of(motion.cameras.at(0).back()).x == Approx(0.5));
    CHECK(scene_hash(blurred) != scene_hash(load_moving(path, 0.125, 1.0)));

    const Scene later = load_moving(path, 0.25, 20.0);
    CHECK_FALSE(later.shutter);
}

TEST_CASE("turns about a point outside, and ways that bend, get as many moments as they take") {
    const ScratchFolder scratch;
    const auto path = scratch.write("scene.toml", CAMERA + R"([[shape]]
type = "box"
motion = [{ time = 0, position = [0, 0, 0] }, { time = 0.3, position = [3, 0, 0] },
          { time = 1, position = [3, 7, 0] }]
)");
    const Scene scene = load_moving(path, 1);
    const MotionKeys& keys = scene.shutter.value().instances.at(0);
    CHECK(keys.size() == 33);
    for (const double time : {0.15, 0.5, 0.9}) {
        const glm::vec3 expected = time < 0.3 ? glm::vec3(float(10 * time), 0, 0)
                                              : glm::vec3(3, float(10 * (time - 0.3)), 0);
        CHECK(glm::length(place_of(mixed(keys, time)) - expected) < 1e-4);
    }
}

TEST_CASE("what is wrong with motion in TOML is said") {
    const ScratchFolder scratch;
    const auto fails = [&](const std::string& shape, const std::string& words) {
        const auto path = scratch.write("scene.toml", CAMERA + "[[shape]]\n" + shape + "\n");
        CHECK_THROWS_WITH(load_scene(path), Catch::Contains(words));
    };
    fails("type = \"box\"\nmotion = [{ position = [0, 0, 0] }]", "time is missing");
    fails("type = \"box\"\nmotion = [{ time = 1 }, { time = 1 }]", "must be later");
    fails("type = \"box\"\nmotion = [{ time = 1, colour = 2 }]", "colour");
    fails("type = \"box\"\nmotion = 3", "motion");
    fails("type = \"sphere\"\nmotion = [{ time = 1, position = [0, 0, 0] }]", "position");
    fails("type = \"rectangle\"\ncorner = [0, 0, 0]\nedge1 = [1, 0, 0]\nedge2 = [0, 1, 0]\n"
          "motion = [{ time = 1 }]",
          "can't go with corner");
}

TEST_CASE("things that shine and move are told of") {
    const ScratchFolder scratch;
    const auto path = scratch.write("scene.toml", CAMERA + R"([[light]]
type = "rectangle"
radiance = 3
position = [0, 3, 0]
motion = [{ time = 0, position = [0, 3, 0] }, { time = 1, position = [1, 3, 0] }]
)");
    const Scene scene = load_moving(path, 1);
    REQUIRE(scene.shutter);
    CHECK(std::ranges::any_of(scene.notes, [](const std::string& note) {
        return note.find("1 things that shine move") != std::string::npos;
    }));
}

TEST_CASE("pbrt's active transforms move shapes and cameras while its shutter is open") {
    const ScratchFolder scratch;
    const std::string head = R"(
TransformTimes 0 2
ActiveTransform EndTime
Translate -1 0 0
ActiveTransform All
LookAt 0 0 5  0 0 0  0 1 0
Camera "perspective" "float shutteropen" 1 "float shutterclose" 1.5
WorldBegin
AttributeBegin
ActiveTransform EndTime
Rotate 90 0 0 1
ActiveTransform All
Translate 3 0 0
Shape "trianglemesh" "point3 P" [0 0 0  1 0 0  0 1 0] "integer indices" [0 1 2]
AttributeEnd
Shape "sphere" "float radius" 0.5
)";
    const auto path = scratch.write("scene.pbrt", head);
    const Scene scene = load_scene(path);
    CHECK(scene.moment == 1.0);
    CHECK(scene.settings.shutter == 0.5f);
    // Half of the way, which is straight, as in pbrt, while it turns by 45 degrees.
    const glm::mat4& half = scene.instances.at(0).object_to_world;
    CHECK(std::abs(half[3].x) == Approx(1.5).margin(1e-5));
    CHECK(half[3].y == Approx(1.5).margin(1e-5));
    CHECK(std::abs(half[0].x) == Approx(std::sqrt(0.5)).margin(1e-5));
    CHECK(std::abs(place_of(scene.cameras[0].camera_to_world).x) == Approx(0.5).margin(1e-5));
    const Scene blurred = load_moving(path, 0.5);
    CHECK(blurred.shutter.value().instances.at(0).size() > 5);
    CHECK(blurred.shutter->cameras.at(0).size() >= 2);
    const auto is_of_motion = [](const std::string& note) {
        return note.find("moves") != std::string::npos;
    };
    CHECK(std::ranges::none_of(scene.notes, is_of_motion));
    CHECK_FALSE(load_scene(scratch.write("still.pbrt", head.substr(head.find("LookAt")))).moment ==
                std::optional(0.25));
}

TEST_CASE("pbrt's spherical camera is a panorama") {
    const ScratchFolder scratch;
    const auto path = scratch.write("scene.pbrt", R"(LookAt 0 0 5  0 0 0  0 1 0
Camera "spherical" "string mapping" "equirectangular"
WorldBegin
Shape "sphere"
)");
    const Scene scene = load_scene(path);
    CHECK(scene.cameras.at(0).projection == Projection::panorama);
}

TEST_CASE("a glTF animation blurs from its second on") {
    const std::filesystem::path slide = in_project("tests/data/motion/slide.gltf");
    LoadOptions options;
    options.scene = "1";
    options.at = 0.25;
    Scene scene = load_scene(slide, options);
    CHECK(scene.moment == 0.25);
    load_shutter(scene, slide, options, 0.25);
    REQUIRE(scene.shutter);
    options.at = 0.5;
    const Scene then = load_scene(slide, options);
    size_t moving = 0;
    for (size_t i = 0; i < scene.instances.size(); i++) {
        const MotionKeys& keys = scene.shutter->instances[i];
        if (keys.empty()) continue;
        moving++;
        CHECK(keys.front() == scene.instances[i].object_to_world);
        CHECK(keys.back() == then.instances[i].object_to_world);
    }
    CHECK(moving > 0);
}
