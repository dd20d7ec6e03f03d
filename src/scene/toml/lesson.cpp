#include "scene/toml/lesson.h"

#include "scene/toml/fields.h"

namespace onde {
namespace {

constexpr Range PLACES{.low = 0, .high = 65536};

void read_place(const TableReader& table, Expectation& e) {
    if (table.has("pixel") == table.has("area"))
        table.fail("", "needs pixel = [x, y] or area = [left, top, right, bottom]; give one");
    if (const auto at = table.integers("pixel", 2, PLACES)) {
        e.low = {at->at(0), at->at(1)};
        e.high = e.low + 1u;
        return;
    }
    const auto area = table.integers("area", 4, PLACES);
    e.low = {area->at(0), area->at(1)};
    e.high = {area->at(2), area->at(3)};
    if (e.low.x >= e.high.x || e.low.y >= e.high.y)
        table.fail("area",
                   "is empty; give [left, top, right, bottom] with left < right, top < bottom");
}

Expectation read_expectation(const TableReader& table) {
    table.allow(keys_of<Expectation>());
    Expectation e;
    read_place(table, e);
    read_fields(table, e);
    if (e.unlike.has_value() == table.has("color"))
        table.fail("", "needs color, or unlike = the other scene's file; give one");
    if (e.unlike) table.require("pixels", e.pixels);
    return e;
}

} // namespace

Lesson read_lesson(const TableReader& table) {
    table.allow(keys_of<Lesson>());
    Lesson lesson;
    read_fields(table, lesson);
    for (const TableReader& expectation : table.tables("expect"))
        lesson.expectations.push_back(read_expectation(expectation));
    return lesson;
}

} // namespace onde
