#include "scene/ply/header.h"

#include "core/error.h"

#include <algorithm>
#include <charconv>
#include <utility>

namespace onde::ply {

namespace {

constexpr size_t MAX_LINE = 4096, MAX_HEADER = 65536;

using Words = std::vector<std::string_view>;

Words split(std::string_view line) {
    Words words;
    for (;;) {
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        if (line.empty()) return words;
        words.push_back(line.substr(0, line.find_first_of(" \t")));
        line.remove_prefix(words.back().size());
    }
}

std::optional<Type> type_named(std::string_view word) {
    constexpr std::pair<std::string_view, Type> TYPES[] = {
        {"char", Type::int8},       {"int8", Type::int8},       {"uchar", Type::uint8},
        {"uint8", Type::uint8},     {"short", Type::int16},     {"int16", Type::int16},
        {"ushort", Type::uint16},   {"uint16", Type::uint16},   {"int", Type::int32},
        {"int32", Type::int32},     {"uint", Type::uint32},     {"uint32", Type::uint32},
        {"float", Type::float32},   {"float32", Type::float32}, {"double", Type::float64},
        {"float64", Type::float64},
    };
    for (const auto& [name, type] : TYPES)
        if (name == word) return type;
    return std::nullopt;
}

template <class Named>
bool has_name(const std::vector<Named>& list, std::string_view name) {
    return std::ranges::any_of(list, [&](const Named& item) { return item.name == name; });
}

class HeaderReader {
  public:
    HeaderReader(const std::string& name, std::string_view file) : name_(name), file_(file) {}

    Header read() {
        if (next_line() != "ply") fail("it doesn't begin with 'ply'");
        bare_returns_ = file_[header_.size - 1] == '\r';
        for (;;) {
            const std::string_view line = next_line();
            const Words words = split(line);
            if (words.size() > 2 && words[1] == "TextureFile" && header_.texture.empty())
                header_.texture = line.substr(size_t(words[2].data() - line.data()));
            if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
            if (words[0] == "end_header") break;
            read_statement(words);
        }
        if (!has_format_) fail("the header ends without a format");
        return std::move(header_);
    }

  private:
    std::string_view next_line() {
        const std::string_view rest = file_.substr(header_.size);
        const size_t length = rest.substr(0, MAX_LINE).find_first_of("\r\n");
        ++line_;
        if (length == std::string_view::npos)
            fail(rest.size() < MAX_LINE ? "the header has no end"
                                        : fmt::format("more than {} characters", MAX_LINE));
        const bool two = rest.substr(length, 2) == "\r\n" && !bare_returns_;
        header_.size += length + (two ? 2 : 1);
        if (header_.size > MAX_HEADER) fail(fmt::format("the header exceeds {} bytes", MAX_HEADER));
        return rest.substr(0, length);
    }

    void read_statement(const Words& words) {
        if (words[0] == "format") return read_format(words);
        if (words[0] == "element") return read_element(words);
        if (words[0] == "property") return read_property(words);
        fail("this is not a line of a PLY header");
    }

    void read_format(const Words& words) {
        constexpr std::pair<std::string_view, Encoding> ENCODINGS[] = {
            {"ascii", Encoding::ascii},
            {"binary_little_endian", Encoding::little_endian},
            {"binary_big_endian", Encoding::big_endian}};
        if (words.size() != 3 || words[2] != "1.0" || has_format_)
            fail("the format is not given once, with version 1.0");
        for (const auto& [name, encoding] : ENCODINGS)
            if (words[1] == name) {
                header_.encoding = encoding;
                has_format_ = true;
            }
        if (!has_format_) fail("the format is neither ascii nor binary");
    }

    void read_element(const Words& words) {
        if (words.size() != 3) fail("an element needs a name and a count");
        if (has_name(header_.elements, words[1])) fail("this element is declared twice");
        Element element{std::string(words[1]), 0, {}};
        const char* end = words[2].data() + words[2].size();
        const auto [stop, error] = std::from_chars(words[2].data(), end, element.count);
        if (error != std::errc() || stop != end) fail("the count is not a number of elements");
        header_.elements.push_back(std::move(element));
    }

    void read_property(const Words& words) {
        const bool list = words.size() == 5 && words[1] == "list";
        if (header_.elements.empty() || (words.size() != 3 && !list))
            fail("this is not a property of an element");
        std::vector<Property>& properties = header_.elements.back().properties;
        if (has_name(properties, words.back())) fail("this property is declared twice");
        Property property{std::string(words.back()), read_type(words[words.size() - 2]), {}};
        if (list) property.count_type = read_type(words[2]);
        if (property.count_type >= Type::float32) fail("a list's length must be an integer");
        properties.push_back(std::move(property));
    }

    Type read_type(std::string_view word) const {
        const std::optional<Type> type = type_named(word);
        if (!type) fail("PLY has no such type");
        return *type;
    }

    [[noreturn]] void fail(const std::string& problem) const {
        throw InputError("{}:{}: not a valid PLY file: {}; export it again", name_, line_, problem);
    }

    const std::string& name_;
    std::string_view file_;
    Header header_; ///< its size is how far we have read
    size_t line_ = 0;
    bool bare_returns_ = false; ///< lines end in CR, so an LF after one is a value's
    bool has_format_ = false;
};

} // namespace

size_t size_of(Type type) {
    constexpr size_t SIZES[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return SIZES[size_t(type)];
}

Header read_header(const std::string& name, std::string_view file) {
    return HeaderReader(name, file).read();
}

} // namespace onde::ply
