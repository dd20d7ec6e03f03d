// What a scene is to show, as its file states it: the gallery prints it and checks its numbers.
#pragma once

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
    float within = 0.0f;               ///< of each component, >= 0
    std::optional<uint32_t> pixels;    ///< how many; without it: all
    std::optional<std::string> unlike; ///< the other scene's file name; then no colour is meant
};

struct Lesson {
    std::string title;
    std::string section;               ///< of the chapter, as "2.5"
    uint32_t order = 0;                ///< among the lessons of a section
    std::vector<std::string> formulas; ///< a line each: x_1 and x^2 stand for indices and powers
    std::string says;                  ///< what the picture shows, in a few sentences
    std::optional<glm::uvec2> inspect; ///< a pixel whose ray tree or path is worth reading
    std::vector<Expectation> expectations;
};

} // namespace onde
