// Whether a picture shows what its scene says that it shows.
#pragma once

#include "image/image.h"
#include "scene/lesson.h"

#include <functional>
#include <string>
#include <vector>

namespace onde {

/// One expectation beside what was measured, in words.
struct LessonCheck {
    std::string where, expected, measured, because;
    bool holds = false;
};

/// The picture of another scene, by its file name; null where there is none.
using OtherPicture = std::function<const Image*(const std::string& scene)>;

/// Throws InputError when an expectation lies outside a picture of that size.
void check_places(const Lesson& lesson, uint32_t width, uint32_t height);

/// Every expectation of the lesson, measured in the scene's linear picture in its own size.
std::vector<LessonCheck> check_lesson(const Lesson& lesson, const Image& picture,
                                      const OtherPicture& other);

} // namespace onde
