// Reads a JSON object key by key, with one sentence for everything that can be wrong with it.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// One object of a JSON file. Every error is an InputError "FILE: KEY PATH: problem". Numbers are
/// never cut to fit: what lies beyond the asked range is refused, and numbers lie in float's range.
/// Keys that nobody asks for are ignored.
class JsonReader {
  public:
    /// `path` is the object's own key path, empty for the root. The file's name and the object must
    /// outlive the reader.
    JsonReader(const nlohmann::json& object, const std::string& file, std::string path);

    bool has(std::string_view key) const;

    std::optional<double> number(std::string_view key) const;
    double number(std::string_view key, double fallback) const;
    /// A whole number, also if written as 3.0.
    std::optional<uint64_t> integer(std::string_view key, uint64_t low, uint64_t high) const;
    /// The index of an element of a list elsewhere in the file.
    std::optional<uint32_t> index(std::string_view key) const;
    bool boolean(std::string_view key, bool fallback) const;
    std::optional<std::string> text(std::string_view key) const;

    /// Exactly N numbers.
    template <size_t N>
    std::optional<std::array<double, N>> vector(std::string_view key) const {
        if (!has(key)) return std::nullopt;
        const std::vector<double> values = numbers(key, N);
        std::array<double, N> result;
        for (size_t i = 0; i < N; ++i) result[i] = values[i];
        return result;
    }
    /// Any number of numbers; none where the key is absent.
    std::vector<double> numbers(std::string_view key) const;
    std::vector<uint32_t> indices(std::string_view key) const;
    std::vector<std::string> texts(std::string_view key) const;

    std::optional<JsonReader> object(std::string_view key) const;
    /// One reader for each object of an array; none where the key is absent.
    std::vector<JsonReader> objects(std::string_view key) const;
    /// What an extension says of this object.
    std::optional<JsonReader> extension(std::string_view name) const;
    /// The names of all keys.
    std::vector<std::string> keys() const;

    /// The value, or an error that says that the key is missing.
    template <class T>
    T require(std::string_view key, std::optional<T> value) const {
        if (!value) fail(key, "is missing");
        return *value;
    }

    /// Throws InputError about the key.
    [[noreturn]] void fail(std::string_view key, const std::string& problem) const;

    const std::string& file() const { return *file_; }
    const std::string& path() const { return path_; }

  private:
    const nlohmann::json* find(std::string_view key) const;
    const nlohmann::json* array(std::string_view key) const;
    std::vector<double> numbers(std::string_view key, size_t count) const;
    double to_number(const nlohmann::json& value, std::string_view key) const;
    uint64_t to_integer(const nlohmann::json& value, std::string_view key, uint64_t low,
                        uint64_t high) const;
    std::string full_path(std::string_view key) const;

    const nlohmann::json* object_;
    const std::string* file_;
    std::string path_;
};

} // namespace onde
