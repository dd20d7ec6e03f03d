#include "scene/stl/file.h"

#include "core/error.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cstring>
#include <vector>

namespace onde::stl {

namespace {

constexpr size_t HEADER = 84, FACET = 50; ///< bytes: 80 of text and a count; 12 floats and 16 bits

template <class T>
T little_endian(std::string_view bytes, size_t offset) {
    char raw[sizeof(T)];
    std::memcpy(raw, bytes.data() + offset, sizeof(T));
    if constexpr (std::endian::native == std::endian::big) std::reverse(raw, raw + sizeof(T));
    return std::bit_cast<T>(raw);
}

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return result;
}

/// Facets claimed by the header of a binary file.
uint64_t claimed(std::string_view bytes) {
    return bytes.size() < HEADER ? 0 : little_endian<uint32_t>(bytes, HEADER - 4);
}

/// Without zero bytes where a binary file has its count, and with the words of ASCII files.
bool is_ascii(std::string_view bytes) {
    if (bytes.size() >= HEADER && bytes.size() == HEADER + FACET * claimed(bytes)) return false;
    const std::string start = lower(bytes.substr(0, 4096));
    if (start.find('\0') != std::string::npos) return false;
    const size_t word = std::min(start.find_first_not_of(" \t\r\n"), start.size());
    return start.compare(word, 5, "solid") == 0 || start.compare(word, 5, "facet") == 0;
}

void read_binary(const std::string& name, std::string_view bytes, const AddFacet& add,
                 Notes& notes) {
    if (bytes.size() < HEADER)
        throw InputError("{}: neither a binary nor an ASCII STL file; export it again", name);
    const uint64_t count = claimed(bytes), held = (bytes.size() - HEADER) / FACET;
    if (count > held)
        throw InputError("{}: its header claims {} triangles, but it holds {}; it is truncated or "
                         "no STL file, copy or export it again",
                         name, count, held);
    if (bytes.size() > HEADER + FACET * count)
        notes.wrong("Bytes after the triangles that the file claims are ignored");
    for (uint64_t i = 0; i < count; ++i) {
        const std::string_view facet = bytes.substr(HEADER + FACET * i, FACET);
        std::array<glm::dvec3, 3> corners;
        for (size_t k = 0; k < 9; ++k) // the facet's normal comes first, which we compute
            corners[k / 3][k % 3] = little_endian<float>(facet, 12 + 4 * k);
        add(corners);
        if (little_endian<uint16_t>(facet, 48) != 0) notes.add("Colours of triangles are ignored");
    }
}

class AsciiReader {
  public:
    AsciiReader(std::string_view text, const AddFacet& add, Notes& notes)
        : lines_(text), add_(add), notes_(notes) {}

    void read() {
        while (const auto line = lines_.next()) read_line(*line);
        if (!corners_.empty()) notes_.wrong("A facet without an end is skipped");
    }

  private:
    void read_line(std::string_view line) {
        text::Words words(line);
        for (std::string_view word = words.next(); !word.empty(); word = words.next()) {
            const std::string keyword = lower(word);
            if (keyword == "solid" || keyword == "endsolid")
                words = after_name(words.rest());
            else if (keyword == "vertex")
                add_corner(words);
            else if (keyword == "endloop" || keyword == "endfacet" || keyword == "facet")
                end_facet();
            else if (keyword == "color")
                notes_.add("Colours of triangles are ignored");
        }
    }

    /// A solid's name goes on to the end of its line, or to a facet on the same one.
    static text::Words after_name(std::string_view rest) {
        const size_t facet = lower(rest).find("facet normal");
        return text::Words(rest.substr(std::min(facet, rest.size())));
    }

    void add_corner(text::Words& words) {
        const double x = words.next_number(), y = words.next_number(), z = words.next_number();
        corners_.emplace_back(x, y, z);
    }

    void end_facet() {
        if (corners_.size() >= 3)
            add_(corners_);
        else if (!corners_.empty())
            notes_.wrong("Facets of fewer than three corners are skipped",
                         "line " + std::to_string(lines_.number()));
        corners_.clear();
    }

    text::Lines lines_;
    const AddFacet& add_;
    Notes& notes_;
    std::vector<glm::dvec3> corners_; ///< of the facet being read
};

} // namespace

void read(const std::string& name, std::string_view bytes, const AddFacet& add, Notes& notes) {
    if (is_ascii(bytes)) return AsciiReader(bytes, add, notes).read();
    read_binary(name, bytes, add, notes);
}

} // namespace onde::stl
