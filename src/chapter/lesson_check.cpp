#include "chapter/lesson_check.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

/// Calls visit(x, y) for each pixel of the expectation's place.
template <class Visit>
void for_place(const Expectation& e, const Visit& visit) {
    for (uint32_t y = e.low.y; y < e.high.y; ++y)
        for (uint32_t x = e.low.x; x < e.high.x; ++x) visit(x, y);
}

double distance(const Image& picture, uint32_t x, uint32_t y, const glm::vec3& color) {
    double largest = 0;
    for (uint32_t c = 0; c < 3; ++c)
        largest = std::max(largest, std::abs(double(picture.pixel(x, y)[c]) - color[c]));
    return largest;
}

glm::vec3 color_at(const Image& picture, uint32_t x, uint32_t y) {
    const auto pixel = picture.pixel(x, y);
    return {pixel[0], pixel[1], pixel[2]};
}

std::string color_text(const glm::vec3& c) {
    if (c.x == c.y && c.y == c.z) return fmt::format("{:.4g}", c.x);
    return fmt::format("({:.4g}, {:.4g}, {:.4g})", c.x, c.y, c.z);
}

std::string place_text(const Expectation& e) {
    if (e.high == e.low + 1u) return fmt::format("pixel ({}, {})", e.low.x, e.low.y);
    return fmt::format("pixels ({}, {}) to ({}, {})", e.low.x, e.low.y, e.high.x - 1, e.high.y - 1);
}

/// Every pixel of the place has the colour; the farthest one is told.
LessonCheck check_color(const Expectation& e, const Image& picture) {
    double worst = -1;
    glm::vec3 farthest(0.0f);
    for_place(e, [&](uint32_t x, uint32_t y) {
        if (const double d = distance(picture, x, y, e.color); d > worst) {
            worst = d;
            farthest = color_at(picture, x, y);
        }
    });
    return {place_text(e), fmt::format("{} within {:g}", color_text(e.color), e.within),
            color_text(farthest), e.because, worst <= e.within};
}

template <class Counts>
uint32_t count(const Expectation& e, const Counts& counts) {
    uint32_t sum = 0;
    for_place(e, [&](uint32_t x, uint32_t y) { sum += counts(x, y); });
    return sum;
}

LessonCheck check_count(const Expectation& e, const Image& picture) {
    const uint32_t found = count(
        e, [&](uint32_t x, uint32_t y) { return distance(picture, x, y, e.color) <= e.within; });
    return {place_text(e), fmt::format("{} times {}", *e.pixels, color_text(e.color)),
            fmt::format("{} times", found), e.because, found == *e.pixels};
}

LessonCheck check_unlike(const Expectation& e, const Image& picture, const Image* other) {
    LessonCheck check{place_text(e), fmt::format("{} unlike {}", *e.pixels, *e.unlike), "",
                      e.because, false};
    if (!other || other->width != picture.width || other->height != picture.height) {
        check.measured = other ? "of another size" : "not rendered";
        return check;
    }
    const uint32_t found = count(e, [&](uint32_t x, uint32_t y) {
        return distance(picture, x, y, color_at(*other, x, y)) > e.within;
    });
    check.measured = fmt::format("{} unlike", found);
    check.holds = found == *e.pixels;
    return check;
}

} // namespace

void check_places(const Lesson& lesson, uint32_t width, uint32_t height) {
    for (const Expectation& e : lesson.expectations)
        if (e.high.x > width || e.high.y > height)
            throw InputError("lesson: {} is not inside a picture of {}x{}", place_text(e), width,
                             height);
    if (lesson.inspect && (lesson.inspect->x >= width || lesson.inspect->y >= height))
        throw InputError("lesson: inspect is not inside a picture of {}x{}", width, height);
}

std::vector<LessonCheck> check_lesson(const Lesson& lesson, const Image& picture,
                                      const OtherPicture& other) {
    check_places(lesson, picture.width, picture.height);
    std::vector<LessonCheck> checks;
    for (const Expectation& e : lesson.expectations)
        checks.push_back(e.unlike   ? check_unlike(e, picture, other(*e.unlike))
                         : e.pixels ? check_count(e, picture)
                                    : check_color(e, picture));
    return checks;
}

} // namespace onde
