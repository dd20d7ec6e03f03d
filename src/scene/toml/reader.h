// Reads a TOML table key by key, with one sentence for everything that can be wrong with it.
#pragma once

#include "core/enum_words.h"
#include "scene/fields.h"

#include <glm/glm.hpp>
#include <toml++/toml.h>

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// One table of a TOML file. Every error is an InputError "FILE:LINE:COLUMN: KEY PATH: problem".
/// Values are finite and in the given range; whole numbers are taken as floats where floats are
/// asked for.
class TableReader {
  public:
    /// `path` is the table's own key path, empty for the root. Both must outlive the reader's use.
    TableReader(const toml::table& table, std::string file, std::string path);

    /// Throws for the first key that is none of these, naming the nearest one.
    void allow(std::span<const std::string_view> keys) const;
    void allow(std::initializer_list<std::string_view> keys) const {
        allow(std::span(keys.begin(), keys.size()));
    }

    /// Reads points as counted from `origin`, in this table and those in it.
    TableReader about(const glm::dvec3& origin) const;

    const glm::dvec3& origin() const { return origin_; }

    bool has(std::string_view key) const { return table_->contains(key); }

    std::optional<float> number(std::string_view key, Range range = ANY_NUMBER) const;
    std::optional<uint32_t> integer(std::string_view key, uint32_t low, uint32_t high) const;
    std::optional<bool> boolean(std::string_view key) const;
    std::optional<std::string> text(std::string_view key) const;
    /// Three numbers.
    std::optional<glm::vec3> vector(std::string_view key, Range range = ANY_NUMBER) const;
    /// The same in double precision, or one number for all three.
    std::optional<glm::dvec3> exact_vector(std::string_view key) const;
    /// A point, or the y of one, counted from the origin.
    std::optional<glm::dvec3> point(std::string_view key) const;
    std::optional<double> height(std::string_view key) const;
    /// Three numbers, or one for all three.
    std::optional<glm::vec3> color(std::string_view key, Range range) const;
    /// Exactly `count` numbers.
    std::optional<std::vector<float>> numbers(std::string_view key, size_t count,
                                              Range range) const;
    /// The same of whole numbers.
    std::optional<std::vector<uint32_t>> integers(std::string_view key, size_t count,
                                                  Range range) const;
    /// The value of an enum that the key's text is the word of.
    template <WordedEnum Enum>
    std::optional<Enum> choice(std::string_view key) const {
        const std::optional<std::string> word = text(key);
        if (!word) return std::nullopt;
        const std::optional<Enum> value = value_of<Enum>(*word);
        if (!value) fail_choice(key, *word, all_words<Enum>());
        return value;
    }
    /// Rows of three numbers.
    std::vector<glm::dvec3> rows(std::string_view key) const;
    /// The texts of an array.
    std::vector<std::string> texts(std::string_view key) const;

    bool is_table(std::string_view key) const;
    /// Whether the key holds an array that doesn't begin with a table.
    bool is_array_of_texts(std::string_view key) const;
    /// One reader for a table, one each for an array of tables, none where the key is absent.
    std::vector<TableReader> tables(std::string_view key) const;

    /// The value, or an error that says that the key is missing.
    template <class T>
    T require(std::string_view key, std::optional<T> value) const {
        if (!value) fail(key, "is missing; add it");
        return *value;
    }

    /// Throws InputError about the key, or about the table when it has no such key.
    [[noreturn]] void fail(std::string_view key, const std::string& problem) const;

    /// "FILE:LINE:COLUMN: KEY PATH" of the key or, without one, of the table.
    std::string where(std::string_view key = {}) const;

  private:
    [[noreturn]] void fail_choice(std::string_view key, const std::string& word,
                                  std::span<const std::string_view> words) const;
    double to_double(const toml::node& node, std::string_view key, Range range) const;
    float to_float(const toml::node& node, std::string_view key, Range range) const;

    const toml::table* table_;
    std::string file_, path_;
    glm::dvec3 origin_{0.0};
};

} // namespace onde
