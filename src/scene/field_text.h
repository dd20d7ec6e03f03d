// Values of fields as a scene file would write them.
#pragma once

#include "core/enum_words.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <string>
#include <vector>

namespace onde {

inline std::string value_text(bool value) {
    return value ? "true" : "false";
}
inline std::string value_text(float value) {
    return fmt::format("{}", value);
}
inline std::string value_text(uint32_t value) {
    return std::to_string(value);
}
inline std::string value_text(const std::string& value) {
    return fmt::format("\"{}\"", value);
}
inline std::string value_text(const std::vector<std::string>& values) {
    std::string text;
    for (const std::string& value : values) text += (text.empty() ? "" : ", ") + value_text(value);
    return "[" + text + "]";
}
inline std::string value_text(const glm::vec2& v) {
    return fmt::format("[{}, {}]", v.x, v.y);
}
inline std::string value_text(const glm::vec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
template <WordedEnum Enum>
std::string value_text(Enum value) {
    return fmt::format("\"{}\"", word_of(value));
}

} // namespace onde
