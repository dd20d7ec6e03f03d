// What several loads of one file share.
#include "core/files.h"
#include "scene/stage.h"
#include "scratch.h"
#include "support/folders.h"

using namespace onde;

namespace {

/// A tetrahedron that goes from the origin by (4, 2, 0) within a second. Scene 1 has a camera.
const std::filesystem::path SLIDE = onde::test::in_project("tests/data/motion/slide.gltf");

} // namespace

TEST_CASE("a stage fits what is shown at all its moments, and loads that are given it have it") {
    const Stage first = fit_stage(SLIDE, {}, {0.0}), both = fit_stage(SLIDE, {}, {1.0, 0.0});
    REQUIRE((first.camera && both.camera && both.ground));
    CHECK(both.camera->focus_distance > 2 * first.camera->focus_distance);
    CHECK(*both.ground < 0);
    CHECK(*both.ground > -0.01f);
    const Scene scene = load_scene(SLIDE, {.at = 1.0, .stage = both});
    CHECK(scene.cameras.at(0).camera_to_world == both.camera->camera_to_world);
    CHECK(scene.environment.ground == both.ground);
    const Scene alone = load_scene(SLIDE, {.at = 0.0});
    CHECK(alone.cameras.at(0).camera_to_world == first.camera->camera_to_world);
    CHECK(alone.environment.ground == first.ground);
}

TEST_CASE("a file with a camera of its own keeps it, and has no stage but its scale") {
    const Stage stage = fit_stage(SLIDE, {.scene = "1"}, {0.0, 1.0});
    CHECK_FALSE(stage.camera);
    CHECK_FALSE(stage.ground);
    CHECK(load_scene(SLIDE, {.scene = "1", .stage = stage}).cameras.size() == 1);
    CHECK(fit_stage(SLIDE, {.scene = "1", .ground = GroundPlane::on}, {0.0, 1.0}).ground);
    CHECK_FALSE(fit_stage(SLIDE, {.ground = GroundPlane::off}, {0.0}).ground);
}

TEST_CASE("all loads of a stage have the scale of the first, however large they are") {
    std::string text = read_file(SLIDE);
    const std::string from = "\"mesh\": 0";
    REQUIRE(text.find(from) != std::string::npos);
    onde::test::ScratchFolder folder;
    text.replace(text.find(from), from.size(), from + ", \"scale\": [1e12, 1e12, 1e12]");
    const auto path = folder.write("large.gltf", text);
    const Stage stage = fit_stage(path, {}, {0.0, 1.0});
    CHECK(stage.exponent < -30);
    const Scene scene = load_scene(path, {.at = 1.0, .stage = stage});
    CHECK(scene_bounds(scene).high.x == Approx(std::ldexp(1e12, stage.exponent)));
}

TEST_CASE("all loads of a stage are counted from the origin of the first, however far out it is") {
    std::string text = read_file(SLIDE);
    const auto replace = [&](const std::string& from, const std::string& to) {
        REQUIRE(text.find(from) != std::string::npos);
        text.replace(text.find(from), from.size(), to);
    };
    replace("\"nodes\": [\n    0", "\"nodes\": [\n    2");
    replace("\"nodes\": [\n  {", "\"nodes\": [\n  {\"mesh\": 0}, {}, {\"children\": [0], "
                                 "\"translation\": [4000000.125, 0, 0]}, {");
    onde::test::ScratchFolder folder;
    const auto path = folder.write("far.gltf", text);
    const Stage stage = fit_stage(path, {}, {0.0, 1.0});
    CHECK(stage.origin.x == Approx(4e6).margin(4));
    const Stage late = fit_stage(path, {}, {1.0});
    CHECK(late.origin != stage.origin);
    for (const double at : {0.0, 1.0}) {
        const Scene far = load_scene(path, {.at = at, .stage = stage});
        const Scene near = load_scene(SLIDE, {.at = at});
        CHECK(far.origin == stage.origin);
        const glm::dvec3 moved = stage.origin + glm::dvec3(scene_bounds(far).high);
        CHECK(glm::length(moved - glm::dvec3(4000000.125, 0, 0) -
                          glm::dvec3(scene_bounds(near).high)) < 1e-5);
    }
}

TEST_CASE("a moment of what is not animated is told to be all the same") {
    onde::test::ScratchFolder folder;
    const auto path = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    const auto has_note = [](const Scene& scene) {
        return std::ranges::any_of(scene.notes, [](const std::string& note) {
            return note.starts_with("Nothing in the file is animated");
        });
    };
    CHECK(has_note(load_scene(path, {.at = 1.0})));
    CHECK_FALSE(has_note(load_scene(path)));
    CHECK_FALSE(has_note(load_scene(SLIDE, {.at = 1.0})));
}
