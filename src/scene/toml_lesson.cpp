#include "scene/toml_lesson.h"

namespace onde {
namespace {

constexpr uint32_t MOST_PIXELS = 65535;

glm::uvec2 whole_pair(const TableReader& table, std::string_view key, std::vector<float> numbers,
                      size_t first) {
    const glm::uvec2 pair(numbers[first], numbers[first + 1]);
    if (glm::vec2(pair) != glm::vec2(numbers[first], numbers[first + 1]))
        table.fail(key, "must be whole numbers");
    return pair;
}

std::optional<glm::uvec2> pixel(const TableReader& table, std::string_view key) {
    const auto numbers = table.numbers(key, 2, {.low = 0, .high = MOST_PIXELS});
    if (!numbers) return std::nullopt;
    return whole_pair(table, key, *numbers, 0);
}

void read_place(const TableReader& table, Expectation& e) {
    if (table.has("pixel") == table.has("area"))
        table.fail("", "needs pixel = [x, y] or area = [left, top, right, bottom]; give one");
    if (const auto at = pixel(table, "pixel")) {
        e.low = *at;
        e.high = *at + 1u;
        return;
    }
    const auto numbers = table.numbers("area", 4, {.low = 0, .high = MOST_PIXELS + 1});
    e.low = whole_pair(table, "area", *numbers, 0);
    e.high = whole_pair(table, "area", *numbers, 2);
    if (e.low.x >= e.high.x || e.low.y >= e.high.y)
        table.fail("area",
                   "is empty; give [left, top, right, bottom] with left < right, top < bottom");
}

Expectation read_expectation(const TableReader& table) {
    table.allow({"pixel", "area", "color", "within", "pixels", "unlike", "because"});
    Expectation e;
    read_place(table, e);
    e.because = table.require("because", table.text("because"));
    e.pixels = table.integer("pixels", 0, UINT32_MAX);
    e.within = table.number("within", NOT_NEGATIVE).value_or(0.005f);
    e.unlike = table.text("unlike");
    if (e.unlike.has_value() == table.has("color"))
        table.fail("", "needs color, or unlike = the other scene's file; give one");
    if (e.unlike)
        table.require("pixels", e.pixels);
    else
        e.color = *table.color("color", NOT_NEGATIVE);
    return e;
}

} // namespace

Lesson read_lesson(const TableReader& table) {
    table.allow({"title", "section", "order", "formulas", "says", "inspect", "expect"});
    Lesson lesson;
    lesson.title = table.require("title", table.text("title"));
    lesson.section = table.text("section").value_or("");
    lesson.order = table.integer("order", 0, 1000).value_or(0);
    if (table.has("formulas")) lesson.formulas = table.texts("formulas");
    lesson.says = table.text("says").value_or("");
    lesson.inspect = pixel(table, "inspect");
    for (const TableReader& expectation : table.tables("expect"))
        lesson.expectations.push_back(read_expectation(expectation));
    return lesson;
}

} // namespace onde
