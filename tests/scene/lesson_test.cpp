// What a scene says that it shows.
#include "scratch.h"

using namespace onde;
using onde::test::load_error;
using onde::test::ScratchFolder;

namespace {

const std::string SPHERE = "[[shape]]\ntype = \"sphere\"\n";
const std::string LESSON = SPHERE + "[lesson]\ntitle = \"A\"\n";

std::string expecting(const std::string& keys) {
    return LESSON + "[[lesson.expect]]\nbecause = \"x\"\n" + keys;
}

} // namespace

TEST_CASE("a lesson has words, formulas and numbers about pixels and areas") {
    const ScratchFolder folder;
    const Scene scene = load_scene(folder.write("a.toml", SPHERE + R"(
[lesson]
title = "Shadows"
section = "2.4"
order = 3
formulas = ["a^2", "b_1"]
says = "Dark."
inspect = [3, 4]
[[lesson.expect]]
pixel = [1, 2]
color = [0.5, 0.25, 1]
because = "1 / 2"
[[lesson.expect]]
area = [10, 20, 30, 25]
color = 0.5
within = 0.25
pixels = 7
because = "seven"
[[lesson.expect]]
area = [0, 0, 2, 1]
unlike = "b.toml"
pixels = 0
because = "alike"
)"));
    REQUIRE(scene.chapter.lesson);
    const Lesson& lesson = *scene.chapter.lesson;
    CHECK(lesson.title == "Shadows");
    CHECK(lesson.section == "2.4");
    CHECK(lesson.formulas == std::vector<std::string>{"a^2", "b_1"});
    CHECK(lesson.order == 3);
    CHECK(lesson.says == "Dark.");
    CHECK(lesson.inspect == glm::uvec2(3, 4));
    REQUIRE(lesson.expectations.size() == 3);
    CHECK(lesson.expectations[0].low == glm::uvec2(1, 2));
    CHECK(lesson.expectations[0].high == glm::uvec2(2, 3));
    CHECK(lesson.expectations[0].color == glm::vec3(0.5f, 0.25f, 1));
    CHECK(lesson.expectations[0].within == 0.005f);
    CHECK_FALSE(lesson.expectations[0].pixels);
    CHECK(lesson.expectations[1].high == glm::uvec2(30, 25));
    CHECK(lesson.expectations[1].pixels == 7u);
    CHECK(lesson.expectations[1].because == "seven");
    CHECK(lesson.expectations[2].unlike == "b.toml");
}

TEST_CASE("the lesson of an included scene stays with that scene") {
    const ScratchFolder folder;
    folder.write("inner.toml", LESSON);
    CHECK_FALSE(
        load_scene(folder.write("outer.toml", "include = [\"inner.toml\"]\n")).chapter.lesson);
}

TEST_CASE("a lesson with a mistake is refused with its place and the remedy") {
    const std::pair<std::string, std::string> cases[] = {
        {SPHERE + "[lesson]\nsays = \"x\"\n", "lesson.title"},
        {LESSON + "expects = 1\n", "did you mean 'expect'"},
        {LESSON + "inspect = [1]\n", "2 numbers"},
        {LESSON + "inspect = [1, -1]\n", "lesson.inspect"},
        {LESSON + "[[lesson.expect]]\npixel = [0, 0]\ncolor = 1\n", "because"},
        {expecting("color = 1\n"), "needs pixel"},
        {expecting("pixel = [0, 0]\narea = [0, 0, 1, 1]\ncolor = 1\n"), "needs pixel"},
        {expecting("pixel = [0.5, 0]\ncolor = 1\n"), "whole numbers"},
        {expecting("area = [4, 0, 4, 1]\ncolor = 1\n"), "is empty"},
        {expecting("pixel = [0, 0]\n"), "needs color"},
        {expecting("pixel = [0, 0]\ncolor = 1\nunlike = \"b.toml\"\n"), "needs color"},
        {expecting("pixel = [0, 0]\nunlike = \"b.toml\"\n"), "pixels"},
        {expecting("pixel = [0, 0]\ncolor = -1\n"), "be negative"},
        {expecting("pixel = [0, 0]\ncolor = 1\nwithin = -1\n"), "within"}};
    for (const auto& [toml, remedy] : cases) {
        const ScratchFolder folder;
        INFO(toml);
        const std::string error = load_error(folder.write("evil.toml", toml));
        CHECK_THAT(error, Catch::Contains("evil.toml:") && Catch::Contains(remedy));
    }
}
