// What a scene is to show, as its file states it: the gallery prints it and checks its numbers.
#pragma once

#include "scene/fields.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace onde {

/// A statement about the pixels low.x <= x < high.x, low.y <= y < high.y, counted from the upper
/// left of the picture in the scene's own size: that `color` is seen in `pixels` of them, or that
/// `pixels` of them differ from those of another scene's picture.
struct Expectation {
    std::string because; ///< where the number comes from: a formula with its values
    glm::uvec2 low{0}, high{0};
    glm::vec3 color{0.0f};             ///< linear
    float within = 0.005f;             ///< of each component
    std::optional<uint32_t> pixels;    ///< how many; without it: all
    std::optional<std::string> unlike; ///< the other scene's file name; then no colour is meant
};

constexpr auto fields_of(TypeTag<Expectation>) {
    using E = Expectation;
    return std::tuple{
        field("because", &E::because, "where the number comes from, a formula with its values",
              {.required = true}),
        LoaderKey{"pixel", "`[x, y]`", "the place, from the upper left in the scene's own size",
                  "`area`"},
        LoaderKey{"area", "`[left, top, right, bottom]`", "the same, the last two just outside",
                  "`pixel`"},
        field_without_key(&E::low, "upper left"),
        field_without_key(&E::high, "lower right"),
        field("color", &E::color, "that the place has, linear",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = "`unlike`"}),
        field("within", &E::within, "how far each component may be from it",
              {.range = NOT_NEGATIVE}),
        field("pixels", &E::pixels, "how many have that colour, or differ",
              {.range = {.low = 0, .high = UINT32_MAX}, .absent = "all; with `unlike` required"}),
        field("unlike", &E::unlike, "file of a scene of the gallery from whose picture they differ",
              {.absent = "`color`"})};
}

struct Lesson {
    std::string title;
    std::string section;               ///< of the chapter, as "2.5"
    uint32_t order = 0;                ///< among the lessons of a section
    std::vector<std::string> formulas; ///< a line each: x_1 and x^2 stand for indices and powers
    std::string says;                  ///< what the picture shows, in a few sentences
    std::optional<glm::uvec2> inspect; ///< a pixel whose ray tree or path is worth reading
    std::vector<Expectation> expectations;
};

constexpr auto fields_of(TypeTag<Lesson>) {
    using L = Lesson;
    return std::tuple{
        field("title", &L::title, "", {.required = true}),
        field("section", &L::section, "of a chapter, as `2.5`: the page's order"),
        field("order", &L::order, "within a section", {.range = {.low = 0, .high = 1000}}),
        field("formulas", &L::formulas,
              "a line each; `x_1`, `x_{12}` and `x^2` are lowered and raised", {.absent = "none"}),
        field("says", &L::says, "what the picture shows"),
        field("inspect", &L::inspect, "a pixel whose ray tree or path the page prints",
              {.range = {.low = 0, .high = 65535}, .absent = "none"}),
        LoaderKey{"expect", "`[[lesson.expect]]`", "numbers that the picture must show", "none"},
        field_without_key(&L::expectations, "expectations")};
}

} // namespace onde
