// The chapter's scenes show the numbers that they state, and the check of that can fail.
#include "chapter/lesson_check.h"
#include "render/picture.h"

#include <map>

namespace onde::test {
namespace {

std::vector<std::filesystem::path> chapter_scenes() {
    std::vector<std::filesystem::path> scenes = project_scenes();
    std::erase_if(scenes, [](const auto& path) { return path.parent_path().stem() != "chapter"; });
    return scenes;
}

Image render_lesson(const Scene& scene) {
    const RenderSettings& set = scene.settings;
    RenderOptions options = small_options(*set.width, *set.height, 4);
    options.depth = set.depth.value_or(options.depth);
    options.integrator = set.integrator.value_or(options.integrator);
    options.filter = set.filter.value_or(RenderOptions().filter);
    return render_scene(scene, options).image;
}

Lesson lesson_of(const Expectation& expectation) {
    Lesson lesson;
    lesson.expectations = {expectation};
    return lesson;
}

} // namespace

TEST_CASE("every chapter scene has a lesson, and its picture shows each number that it states") {
    std::map<std::string, Image> pictures;
    std::map<std::string, Scene> scenes;
    for (const auto& path : chapter_scenes()) {
        Scene scene = load_scene(path);
        INFO(path.filename().string());
        REQUIRE(scene.chapter.lesson);
        CHECK_FALSE(scene.chapter.lesson->title.empty());
        CHECK_FALSE(scene.chapter.lesson->formulas.empty());
        CHECK_FALSE(scene.chapter.lesson->says.empty());
        if (scene.chapter.lesson->expectations.empty()) continue;
        pictures[path.filename()] = render_lesson(scene);
        scenes[path.filename()] = std::move(scene);
    }
    CHECK(pictures.size() >= 19);
    const auto other = [&](const std::string& name) { return &pictures.at(name); };
    for (const auto& [name, scene] : scenes)
        for (const LessonCheck& check :
             check_lesson(*scene.chapter.lesson, pictures.at(name), other)) {
            INFO(name << ", " << check.where << ": expected " << check.expected << ", measured "
                      << check.measured);
            CHECK(check.holds);
        }
}

TEST_CASE("an expectation holds just where the picture is as it says") {
    Image picture(4, 2, 3), other(4, 2, 3);
    std::ranges::fill(picture.pixels, 0.5f);
    std::ranges::fill(other.pixels, 0.5f);
    picture.pixel(2, 1)[1] = 0.75f;
    const auto check = [&](Expectation e) {
        return check_lesson(
                   lesson_of(e), picture,
                   [&](const std::string& name) { return name == "other" ? &other : nullptr; })
            .at(0);
    };
    Expectation everywhere{"", {0, 0}, {4, 2}, glm::vec3(0.5f), 0.125f, {}, {}};
    CHECK_FALSE(check(everywhere).holds);
    CHECK(check(everywhere).measured == "(0.5, 0.75, 0.5)");
    everywhere.within = 0.25f;
    CHECK(check(everywhere).holds);
    CHECK(check({"", {1, 1}, {2, 2}, glm::vec3(0.5f), 0, {}, {}}).holds);
    CHECK_FALSE(check({"", {2, 1}, {3, 2}, glm::vec3(0.5f), 0, {}, {}}).holds);

    Expectation counted{"", {0, 0}, {4, 2}, glm::vec3(0.5f), 0, 7u, {}};
    CHECK(check(counted).holds);
    counted.pixels = 8;
    CHECK_FALSE(check(counted).holds);
    CHECK(check(counted).measured == "7 times");

    Expectation unlike{"", {0, 0}, {4, 2}, {}, 0.125f, 1u, "other"};
    CHECK(check(unlike).holds);
    unlike.pixels = 0;
    CHECK_FALSE(check(unlike).holds);
    unlike.unlike = "missing";
    CHECK_FALSE(check(unlike).holds);
    CHECK(check(unlike).measured == "not rendered");
}

TEST_CASE("an expectation outside the picture is refused with its place") {
    const Lesson lesson = lesson_of({"", {3, 0}, {5, 1}, {}, 0, {}, {}});
    CHECK_THROWS_WITH(check_places(lesson, 4, 2),
                      Catch::Contains("pixels (3, 0) to (4, 0)") && Catch::Contains("4x2"));
    Lesson inspected;
    inspected.inspect = glm::uvec2(0, 2);
    CHECK_THROWS_WITH(check_places(inspected, 4, 2), Catch::Contains("inspect"));
}

} // namespace onde::test
