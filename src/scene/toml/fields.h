// Reads the keys of a TOML table into the members of things by their tables of fields.
#pragma once

#include "scene/angle.h"
#include "scene/fields.h"
#include "scene/toml/reader.h"

#include <fmt/format.h>

#include <functional>
#include <span>

namespace onde {

/// The index of the texture that a key names.
using TextureReader = std::function<int32_t(std::string_view key, bool srgb)>;

template <Fielded T>
void read_fields(const TableReader& table, T& thing, const TextureReader& textures = {},
                 std::span<const std::string_view> others = {});

namespace toml_detail {

inline std::optional<float> read(const TableReader& table, std::string_view key,
                                 const FieldRules& rules, TypeTag<float>) {
    if (rules.form == Form::height) {
        const auto y = table.height(key);
        return y ? std::optional(float(*y)) : std::nullopt;
    }
    const auto value = table.number(key, rules.range);
    return value && rules.form == Form::degrees ? radians_of(*value) : value;
}

inline std::optional<uint32_t> read(const TableReader& table, std::string_view key,
                                    const FieldRules& rules, TypeTag<uint32_t>) {
    return table.integer(key, uint32_t(rules.range.low), uint32_t(rules.range.high));
}

inline std::optional<bool> read(const TableReader& table, std::string_view key, const FieldRules&,
                                TypeTag<bool>) {
    return table.boolean(key);
}

inline std::optional<std::string> read(const TableReader& table, std::string_view key,
                                       const FieldRules&, TypeTag<std::string>) {
    return table.text(key);
}

inline std::optional<glm::vec2> read(const TableReader& table, std::string_view key,
                                     const FieldRules& rules, TypeTag<glm::vec2>) {
    const auto values = table.numbers(key, 2, rules.range);
    if (!values) return std::nullopt;
    return glm::vec2((*values)[0], (*values)[1]);
}

inline std::optional<glm::uvec2> read(const TableReader& table, std::string_view key,
                                      const FieldRules& rules, TypeTag<glm::uvec2>) {
    const auto values = table.integers(key, 2, rules.range);
    if (!values) return std::nullopt;
    return glm::uvec2((*values)[0], (*values)[1]);
}

inline std::optional<std::vector<std::string>> read(const TableReader& table, std::string_view key,
                                                    const FieldRules&,
                                                    TypeTag<std::vector<std::string>>) {
    if (!table.has(key)) return std::nullopt;
    return table.texts(key);
}

inline std::optional<glm::vec3> read(const TableReader& table, std::string_view key,
                                     const FieldRules& rules, TypeTag<glm::vec3>) {
    if (rules.form == Form::color) return table.color(key, rules.range);
    if (rules.form == Form::point) {
        const auto point = table.point(key);
        return point ? std::optional(glm::vec3(*point)) : std::nullopt;
    }
    const auto value = table.vector(key, rules.range);
    if (value && rules.form == Form::travel) {
        const glm::dvec3 travel(*value);
        if (glm::length(travel) < 1e-30) table.fail(key, "must not be zero");
        return glm::vec3(-glm::normalize(travel));
    }
    return value && rules.form == Form::degrees ? radians_of(*value) : value;
}

template <WordedEnum Enum>
std::optional<Enum> read(const TableReader& table, std::string_view key, const FieldRules&,
                         TypeTag<Enum>) {
    return table.choice<Enum>(key);
}

template <Fielded T>
std::optional<T> read(const TableReader& table, std::string_view key, const FieldRules&,
                      TypeTag<T>) {
    for (const TableReader& inner : table.tables(key)) {
        T thing;
        inner.allow(keys_of<T>());
        read_fields(inner, thing);
        return thing;
    }
    return std::nullopt;
}

/// The key or its other name, whichever is there.
inline std::string_view given_key(const TableReader& table, std::string_view key,
                                  std::string_view alias) {
    if (alias.empty() || !table.has(alias)) return key;
    if (table.has(key))
        table.fail(alias, fmt::format("is another name of {}; give one of them", key));
    return alias;
}

} // namespace toml_detail

/// Members whose keys are absent keep their values. Throws InputError for values out of range and
/// required keys that are missing. What is no key of the table is left to TableReader::allow(), and
/// keys of `others` are not this thing's in this table.
template <Fielded T>
void read_fields(const TableReader& table, T& thing, const TextureReader& textures,
                 std::span<const std::string_view> others) {
    const auto read_field = [&]<class Value>(const Field<T, Value, true>& field, Value& value) {
        const FieldRules& rules = field.rules;
        const std::string_view key = toml_detail::given_key(table, field.key, rules.alias);
        if constexpr (std::is_same_v<Value, int32_t>) {
            if (table.has(key)) value = textures(key, rules.form == Form::srgb_texture);
        } else {
            auto read = toml_detail::read(table, key, rules, TypeTag<typename Held<Value>::type>{});
            if (rules.required)
                value = table.require(key, std::move(read));
            else if (read)
                value = std::move(*read);
        }
    };
    for_each_field(
        thing, [&]<class Value, bool HAS_KEY>(const Field<T, Value, HAS_KEY>& field, Value& value) {
            if constexpr (HAS_KEY)
                if (std::ranges::find(others, field.key) == others.end()) read_field(field, value);
        });
}

/// Reads a thing whose keys, with those of the Others, are all that its table may have.
template <Fielded T, Fielded... Others>
T read_only(const TableReader& table) {
    T thing;
    table.allow(keys_of<T, Others...>());
    read_fields(table, thing);
    return thing;
}

} // namespace onde
