#include "scene/json_reader.h"

#include "core/error.h"
#include "core/shown.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace onde {

using Json = nlohmann::json;

/// The value as a sentence shows it.
static std::string shown_value(const Json& value) {
    if (value.is_object()) return "an object";
    if (value.is_array()) return "an array of " + std::to_string(value.size());
    return shown(value.dump(-1, ' ', false, Json::error_handler_t::replace), 40);
}

JsonReader::JsonReader(const Json& object, const std::string& file, std::string path)
    : object_(&object), file_(&file), path_(std::move(path)) {
    if (!object.is_object())
        throw InputError("{}: {}must be an object, not {}; export it again", file,
                         path_.empty() ? "its JSON " : path_ + ": ", shown_value(object));
}

std::string JsonReader::full_path(std::string_view key) const {
    if (path_.empty()) return shown(key);
    return path_ + "." + shown(key);
}

void JsonReader::fail(std::string_view key, const std::string& problem) const {
    throw InputError("{}: {}: {}; export it again", *file_, full_path(key), problem);
}

const Json* JsonReader::find(std::string_view key) const {
    const auto found = object_->find(key);
    return found == object_->end() ? nullptr : &*found;
}

bool JsonReader::has(std::string_view key) const {
    return find(key);
}

double JsonReader::to_number(const Json& value, std::string_view key) const {
    if (!value.is_number()) fail(key, "must be a number, not " + shown_value(value));
    const double number = value.get<double>();
    if (!(std::abs(number) <= double(std::numeric_limits<float>::max())))
        fail(key, "is too large a number: " + shown_value(value));
    return number;
}

std::optional<double> JsonReader::number(std::string_view key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    return to_number(*value, key);
}

double JsonReader::number(std::string_view key, double fallback) const {
    return number(key).value_or(fallback);
}

uint64_t JsonReader::to_integer(const Json& value, std::string_view key, uint64_t low,
                                uint64_t high) const {
    constexpr double EXACT = 9007199254740992.0; // 2^53
    std::optional<uint64_t> number;
    if (value.is_number_unsigned()) {
        number = value.get<uint64_t>();
    } else if (value.is_number_float()) {
        const double real = value.get<double>();
        if (real >= 0.0 && real <= EXACT && real == std::floor(real)) number = uint64_t(real);
    }
    if (number && *number >= low && *number <= high) return *number;
    fail(key,
         fmt::format("must be a whole number {} to {}, not {}", low, high, shown_value(value)));
}

std::optional<uint64_t> JsonReader::integer(std::string_view key, uint64_t low,
                                            uint64_t high) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    return to_integer(*value, key, low, high);
}

constexpr uint64_t MAX_INDEX = std::numeric_limits<uint32_t>::max() - 1;

std::optional<uint32_t> JsonReader::index(std::string_view key) const {
    const auto value = integer(key, 0, MAX_INDEX);
    if (!value) return std::nullopt;
    return uint32_t(*value);
}

bool JsonReader::boolean(std::string_view key, bool fallback) const {
    const Json* value = find(key);
    if (!value) return fallback;
    if (!value->is_boolean()) fail(key, "must be true or false, not " + shown_value(*value));
    return value->get<bool>();
}

std::optional<std::string> JsonReader::text(std::string_view key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    if (!value->is_string()) fail(key, "must be a text, not " + shown_value(*value));
    return value->get<std::string>();
}

const Json* JsonReader::array(std::string_view key) const {
    const Json* value = find(key);
    if (value && !value->is_array()) fail(key, "must be an array, not " + shown_value(*value));
    return value;
}

std::vector<double> JsonReader::numbers(std::string_view key) const {
    const Json* values = array(key);
    std::vector<double> result;
    if (!values) return result;
    result.reserve(values->size());
    for (const Json& value : *values) result.push_back(to_number(value, key));
    return result;
}

std::vector<double> JsonReader::numbers(std::string_view key, size_t count) const {
    const Json* values = array(key);
    if (values->size() != count)
        fail(key, fmt::format("must be {} numbers, not {}", count, values->size()));
    return numbers(key);
}

std::vector<uint32_t> JsonReader::indices(std::string_view key) const {
    const Json* values = array(key);
    std::vector<uint32_t> result;
    if (!values) return result;
    result.reserve(values->size());
    for (const Json& value : *values)
        result.push_back(uint32_t(to_integer(value, key, 0, MAX_INDEX)));
    return result;
}

std::vector<std::string> JsonReader::texts(std::string_view key) const {
    const Json* values = array(key);
    std::vector<std::string> result;
    if (!values) return result;
    for (const Json& value : *values) {
        if (!value.is_string()) fail(key, "must be texts, not " + shown_value(value));
        result.push_back(value.get<std::string>());
    }
    return result;
}

std::optional<JsonReader> JsonReader::object(std::string_view key) const {
    const Json* value = find(key);
    if (!value) return std::nullopt;
    return JsonReader(*value, *file_, full_path(key));
}

std::vector<JsonReader> JsonReader::objects(std::string_view key) const {
    const Json* values = array(key);
    std::vector<JsonReader> result;
    if (!values) return result;
    result.reserve(values->size());
    for (const Json& value : *values)
        result.emplace_back(value, *file_, fmt::format("{}[{}]", full_path(key), result.size()));
    return result;
}

std::optional<JsonReader> JsonReader::extension(std::string_view name) const {
    const auto extensions = object("extensions");
    return extensions ? extensions->object(name) : std::nullopt;
}

std::vector<std::string> JsonReader::keys() const {
    std::vector<std::string> result;
    for (const auto& [key, value] : object_->items()) result.push_back(key);
    return result;
}

} // namespace onde
