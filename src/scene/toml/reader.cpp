#include "scene/toml/reader.h"

#include "core/error.h"
#include "core/nearest.h"
#include "core/shown.h"

#include <algorithm>
#include <cmath>

namespace onde {

TableReader::TableReader(const toml::table& table, std::string file, std::string path)
    : table_(&table), file_(std::move(file)), path_(std::move(path)) {}

std::string TableReader::where(std::string_view key) const {
    const toml::node* node = key.empty() ? nullptr : table_->get(key);
    const toml::source_region& source = node ? node->source() : table_->source();
    std::string full = path_;
    if (!key.empty()) full += (full.empty() ? "" : ".") + shown(key);
    const std::string place = source.begin ? fmt::format(":{}:{}", uint32_t(source.begin.line),
                                                         uint32_t(source.begin.column))
                                           : "";
    return full.empty() ? file_ + place : fmt::format("{}{}: {}", file_, place, full);
}

void TableReader::fail(std::string_view key, const std::string& problem) const {
    throw InputError("{} {}", where(key), shown(problem, 1000));
}

static std::string joined(std::span<const std::string_view> names) {
    std::string list;
    for (auto name = names.begin(); name != names.end(); ++name)
        if (std::find(names.begin(), name, *name) == name) // two of a table's things may know it
            list += (list.empty() ? "" : ", ") + std::string(*name);
    return list;
}

TableReader TableReader::about(const glm::dvec3& origin) const {
    TableReader reader = *this;
    reader.origin_ = origin;
    return reader;
}

void TableReader::allow(std::span<const std::string_view> keys) const {
    for (const auto& [key, node] : *table_) {
        if (std::find(keys.begin(), keys.end(), key.str()) != keys.end()) continue;
        fail(key.str(), fmt::format("is not a key here; did you mean '{}'? Allowed: {}",
                                    nearest(key.str(), keys), joined(keys)));
    }
}

double TableReader::to_double(const toml::node& node, std::string_view key, Range range) const {
    const std::optional<double> value = node.value<double>();
    if (!value || node.is_boolean()) fail(key, "must be a number");
    if (range.contains(*value)) return *value;
    fail(key, fmt::format("{}, not {}", why_not_in(range, *value), *value));
}

float TableReader::to_float(const toml::node& node, std::string_view key, Range range) const {
    return float(to_double(node, key, range));
}

std::optional<float> TableReader::number(std::string_view key, Range range) const {
    const toml::node* node = table_->get(key);
    if (!node) return std::nullopt;
    return to_float(*node, key, range);
}

std::optional<uint32_t> TableReader::integer(std::string_view key, uint32_t low,
                                             uint32_t high) const {
    const toml::node* node = table_->get(key);
    if (!node) return std::nullopt;
    const std::optional<int64_t> value = node->value_exact<int64_t>();
    if (!value) fail(key, "must be a whole number");
    if (*value < int64_t(low) || *value > int64_t(high))
        fail(key, fmt::format("must lie between {} and {}, not {}", low, high, *value));
    return uint32_t(*value);
}

std::optional<bool> TableReader::boolean(std::string_view key) const {
    const toml::node* node = table_->get(key);
    if (!node) return std::nullopt;
    const std::optional<bool> value = node->value_exact<bool>();
    if (!value) fail(key, "must be true or false");
    return value;
}

std::optional<std::string> TableReader::text(std::string_view key) const {
    const toml::node* node = table_->get(key);
    if (!node) return std::nullopt;
    const std::optional<std::string> value = node->value_exact<std::string>();
    if (!value) fail(key, "must be a text in quotes");
    return value;
}

std::optional<std::vector<float>> TableReader::numbers(std::string_view key, size_t count,
                                                       Range range) const {
    const toml::node* node = table_->get(key);
    if (!node) return std::nullopt;
    const toml::array* array = node->as_array();
    if (!array || array->size() != count)
        fail(key, fmt::format("must be {} numbers in brackets", count));
    std::vector<float> values;
    for (const toml::node& element : *array) values.push_back(to_float(element, key, range));
    return values;
}

std::optional<std::vector<uint32_t>> TableReader::integers(std::string_view key, size_t count,
                                                           Range range) const {
    const auto values = numbers(key, count, range);
    if (!values) return std::nullopt;
    const std::vector<uint32_t> whole(values->begin(), values->end());
    if (!std::ranges::equal(whole, *values)) fail(key, "must be whole numbers");
    return whole;
}

std::optional<glm::vec3> TableReader::vector(std::string_view key, Range range) const {
    const auto values = numbers(key, 3, range);
    if (!values) return std::nullopt;
    return glm::vec3((*values)[0], (*values)[1], (*values)[2]);
}

std::optional<glm::dvec3> TableReader::exact_vector(std::string_view key) const {
    if (!color(key, ANY_NUMBER)) return std::nullopt; // or an error
    const toml::node& node = *table_->get(key);
    glm::dvec3 value;
    for (size_t i = 0; i < 3; ++i)
        value[i] = to_double(node.is_array() ? node.as_array()->at(i) : node, key, ANY_NUMBER);
    return value;
}

std::optional<glm::dvec3> TableReader::point(std::string_view key) const {
    if (!vector(key)) return std::nullopt;
    return *exact_vector(key) - origin_;
}

std::optional<double> TableReader::height(std::string_view key) const {
    if (!number(key)) return std::nullopt;
    return to_double(*table_->get(key), key, ANY_NUMBER) - origin_.y;
}

std::optional<glm::vec3> TableReader::color(std::string_view key, Range range) const {
    const toml::node* node = table_->get(key);
    if (node && node->is_number()) return glm::vec3(*number(key, range));
    if (node && !node->is_array()) fail(key, "must be three numbers in brackets, or one for all");
    return vector(key, range);
}

void TableReader::fail_choice(std::string_view key, const std::string& word,
                              std::span<const std::string_view> words) const {
    fail(key, fmt::format("can't be '{}'; did you mean '{}'? Allowed: {}", shown(word),
                          nearest(word, words), joined(words)));
}

static const toml::array* array_of(const toml::table& table, std::string_view key) {
    return table.get_as<toml::array>(key);
}

std::vector<glm::dvec3> TableReader::rows(std::string_view key) const {
    std::vector<glm::dvec3> result;
    const toml::array* rows = array_of(*table_, key);
    if (!rows) fail(key, "must be rows of three numbers, as [[0, 1, 2], ...]");
    for (const toml::node& node : *rows) {
        const toml::array* row = node.as_array();
        if (!row || row->size() != 3) fail(key, "must be rows of three numbers");
        glm::dvec3 value;
        for (size_t i = 0; i < 3; ++i) value[i] = to_double(*row->get(i), key, ANY_NUMBER);
        result.push_back(value);
    }
    return result;
}

std::vector<std::string> TableReader::texts(std::string_view key) const {
    std::vector<std::string> result;
    const toml::array* array = array_of(*table_, key);
    if (!array) fail(key, "must be texts in brackets");
    for (const toml::node& node : *array) {
        const auto value = node.value_exact<std::string>();
        if (!value) fail(key, "must be texts in brackets");
        result.push_back(*value);
    }
    return result;
}

bool TableReader::is_table(std::string_view key) const {
    const toml::node* node = table_->get(key);
    return node && node->is_table();
}

bool TableReader::is_array_of_texts(std::string_view key) const {
    const toml::array* array = array_of(*table_, key);
    return array && (array->empty() || !array->get(0)->is_table());
}

std::vector<TableReader> TableReader::tables(std::string_view key) const {
    const toml::node* node = table_->get(key);
    if (!node) return {};
    const std::string path = path_.empty() ? std::string(key) : path_ + "." + std::string(key);
    if (const toml::table* table = node->as_table())
        return {TableReader(*table, file_, path).about(origin_)};
    std::vector<TableReader> readers;
    const toml::array* array = node->as_array();
    if (!array) fail(key, fmt::format("must be a table; write [{0}] or [[{0}]]", key));
    for (const toml::node& element : *array) {
        const toml::table* table = element.as_table();
        if (!table) fail(key, fmt::format("must be tables; write [[{}]]", key));
        const std::string own = fmt::format("{}[{}]", path, readers.size());
        readers.push_back(TableReader(*table, file_, own).about(origin_));
    }
    return readers;
}

} // namespace onde
