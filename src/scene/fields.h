// Tables of fields: what a thing of a scene has, listed once beside its struct. From a table follow
// the keys of scene files with their ranges, defaults and documentation, the check of a scene, its
// hash, how scenes are merged and what reports print.
//
//     struct Fog { float density = 0; };
//     constexpr auto fields_of(TypeTag<Fog>) {
//         return std::tuple{field("density", &Fog::density, "per unit of length",
//                                 {.range = NOT_NEGATIVE})};
//     }
//
// A table that forgets a member does not compile.
#pragma once

#include "core/enum_words.h"

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace onde {

/// The values that a number may have; the ends belong to it.
struct Range {
    double low = -std::numeric_limits<float>::max();
    double high = std::numeric_limits<float>::max();

    constexpr bool contains(double value) const { return value >= low && value <= high; }
};

inline constexpr Range ANY_NUMBER{};
inline constexpr Range NOT_NEGATIVE{.low = 0.0};
inline constexpr Range POSITIVE{.low = 1e-30};
inline constexpr Range UNIT{.low = 0.0, .high = 1.0};

/// What is wrong with a value outside of the range: "must lie between 0 and 1", "must be above 0",
/// "is too large for single precision, which ends at 3.4e+38", ...
std::string why_not_in(const Range& range, double value);

/// What a value means beyond its type.
enum class Form {
    plain,
    color,          ///< in files three numbers, or one for all
    degrees,        ///< in files; the member holds radians
    point,          ///< in files in their coordinates; the member is counted from the origin
    height,         ///< the same of a y alone
    length,         ///< of world units: grows with what it belongs to
    travel,         ///< in files the way that light travels; the member is the unit vector against
    srgb_texture,   ///< in files an image; the member is an index, or NO_TEXTURE
    linear_texture, ///< the same for data
    material,       ///< an index of a material
    group,          ///< the name of a group of lights, or empty
    name,           ///< an index of a name, or NO_NAME
    grid,           ///< an index of a grid of densities, or NO_GRID
};

constexpr bool is_texture(Form form) {
    return form == Form::srgb_texture || form == Form::linear_texture;
}

struct FieldRules {
    Range range{}; ///< of a number, or of each of several
    Form form = Form::plain;
    bool required = false;        ///< in files
    std::string_view alias = {};  ///< another name of the key
    std::string_view absent = {}; ///< what an absent key means, if not the initial value
};

/// Of what has no name.
inline constexpr uint32_t NO_NAME = 0xffffffff;

/// The key of whatever shines.
inline constexpr std::string_view GROUP_MEANING = "of its light, for `--aov light-groups`";
inline constexpr FieldRules GROUP_RULES{.form = Form::group, .absent = "none: the others"};

/// A member. Without a key, files can't give it directly; `meaning` is its name then.
template <class Owner, class Value, bool HAS_KEY>
struct Field {
    std::string_view key;
    Value Owner::*member;
    std::string_view meaning; ///< for the documentation, after the kind of value
    FieldRules rules;
};

/// A key that has no member of its own: a loader makes something of it.
struct LoaderKey {
    std::string_view key, value, meaning, absent;
};

template <class Owner, class Value>
constexpr auto field(std::string_view key, Value Owner::*member, std::string_view meaning,
                     FieldRules rules = {}) {
    return Field<Owner, Value, true>{key, member, meaning, rules};
}

template <class Owner, class Value>
constexpr auto field_without_key(Value Owner::*member, std::string_view name,
                                 FieldRules rules = {}) {
    return Field<Owner, Value, false>{{}, member, name, rules};
}

/// What messages call a member.
template <class Owner, class Value, bool HAS_KEY>
constexpr std::string_view name_of(const Field<Owner, Value, HAS_KEY>& field) {
    return field.key.empty() ? field.meaning : field.key;
}

template <class T>
struct TypeTag {};

/// A struct with a table.
template <class T>
concept Fielded = requires {
    fields_of(TypeTag<T>{});
};

namespace fields_detail {

/// Initializes a member of any type; only for expressions that are never evaluated.
struct AnyValue {
    template <class T>
    operator T() const;
};

/// The most initializers that an aggregate takes: its members.
template <class T, class... Given>
consteval size_t count_members() {
    if constexpr (requires { T{Given{}..., AnyValue{}}; })
        return count_members<T, Given..., AnyValue>();
    else
        return sizeof...(Given);
}

template <class T>
inline constexpr bool IS_MEMBER = false;
template <class Owner, class Value, bool HAS_KEY>
inline constexpr bool IS_MEMBER<Field<Owner, Value, HAS_KEY>> = true;

template <Fielded T>
consteval auto checked_fields() {
    constexpr auto fields = fields_of(TypeTag<T>{});
    constexpr size_t listed = std::apply(
        []<class... F>(const F&...) { return (size_t(IS_MEMBER<F>) + ... + 0); }, fields);
    static_assert(listed == count_members<T>(), "the table of fields forgets a member");
    return fields;
}

} // namespace fields_detail

template <Fielded T>
inline constexpr auto FIELDS_OF = fields_detail::checked_fields<T>();

/// Calls visit(entry) for each Field and LoaderKey of the table, in its order.
template <Fielded T, class Visit>
constexpr void for_each_entry(const Visit& visit) {
    std::apply([&](const auto&... entry) { (visit(entry), ...); }, FIELDS_OF<T>);
}

/// Calls visit(field, value) for each member of a thing, in the table's order.
template <class T, class Visit>
requires Fielded<std::remove_const_t<T>>
constexpr void for_each_field(T& thing, const Visit& visit) {
    for_each_entry<std::remove_const_t<T>>([&]<class Entry>(const Entry& entry) {
        if constexpr (fields_detail::IS_MEMBER<Entry>) visit(entry, thing.*entry.member);
    });
}

/// The keys of things that share a table in a file.
template <Fielded... T>
std::vector<std::string_view> keys_of() {
    std::vector<std::string_view> keys;
    const auto add = [&](std::string_view key) {
        if (!key.empty()) keys.push_back(key);
    };
    const auto add_entry = [&]<class Entry>(const Entry& entry) {
        add(entry.key);
        if constexpr (fields_detail::IS_MEMBER<Entry>) add(entry.rules.alias);
    };
    (for_each_entry<T>(add_entry), ...);
    return keys;
}

/// What an optional holds, or the type itself.
template <class T>
struct Held {
    using type = T;
};
template <class T>
struct Held<std::optional<T>> {
    using type = T;
};

} // namespace onde
