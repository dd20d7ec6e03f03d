// Things with a table of fields as JSON objects, by their keys and in the units of scene files.
#pragma once

#include "app/json.h"
#include "scene/fields.h"

#include <glm/glm.hpp>

namespace onde::app {

template <Fielded T>
Json json_fields(const T& thing);

namespace field_json_detail {

inline Json json_value(const FieldRules& rules, float value) {
    return rules.form == Form::degrees ? glm::degrees(value) : value;
}

template <glm::length_t N>
Json json_value(const FieldRules& rules, const glm::vec<N, float>& v) {
    Json list = Json::array();
    for (glm::length_t i = 0; i < N; ++i) list.push_back(json_value(rules, v[i]));
    return list;
}

/// By columns, as glTF writes matrices.
inline Json json_value(const FieldRules&, const glm::mat4& m) {
    return Json(std::vector<float>(&m[0][0], &m[0][0] + 16));
}

template <WordedEnum Enum>
Json json_value(const FieldRules&, Enum value) {
    return word_of(value);
}

template <class T>
requires std::is_same_v<T, bool> || std::is_same_v<T, uint32_t> || std::is_same_v<T, std::string>
    Json json_value(const FieldRules&, const T& value) {
    return value;
}

inline Json json_value(const FieldRules&, const std::vector<std::string>& texts) {
    return texts;
}

template <Fielded T>
Json json_value(const FieldRules&, const T& thing) {
    return json_fields(thing);
}

} // namespace field_json_detail

/// An object with a value for each member; null for those that are absent.
template <Fielded T>
Json json_fields(const T& thing) {
    Json object = Json::object();
    const auto add = [&](const auto& field, const auto& value) {
        using field_json_detail::json_value;
        Json& entry = object[std::string(name_of(field))];
        if constexpr (requires { json_value(field.rules, *value); }) {
            if (value) entry = json_value(field.rules, *value);
        } else {
            entry = json_value(field.rules, value);
        }
    };
    for_each_field(thing, add);
    return object;
}

} // namespace onde::app
