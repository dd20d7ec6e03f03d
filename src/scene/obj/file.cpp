#include "scene/obj/file.h"

#include "core/error.h"
#include "scene/mesh_parts.h"
#include "scene/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <limits>
#include <unordered_map>

namespace onde::obj {

namespace {

using text::Words;

constexpr double NOT_A_NUMBER = std::numeric_limits<double>::quiet_NaN();
const glm::vec3 NO_COLOR(std::numeric_limits<float>::quiet_NaN());
constexpr size_t MAX_CORNERS = size_t(1) << 30;

/// A foreign word in a message: printable and short.
std::string quoted(std::string_view word) {
    std::string result;
    for (const char c : word.substr(0, 40)) result += c > ' ' && c < 0x7f ? c : '?';
    return result;
}

class Reader {
  public:
    Reader(const std::string& name, std::string_view text, Notes& notes, GradualSpending& cost)
        : name_(name), lines_(text), notes_(notes), cost_(cost) {}

    File read();

  private:
    void read_statement(Words words);
    void read_vertex(Words& words);
    void read_face(Words& words);
    Corner read_corner(std::string_view word) const;
    int32_t read_index(std::string_view digits, size_t count, std::string_view word) const;
    void read_smoothing(Words& words);
    void read_material(Words& words);
    void check_indices() const;
    void check_index(const Face& face, int32_t index, size_t count, const char* kind) const;

    const std::string& name_;
    text::Lines lines_;
    Notes& notes_;
    GradualSpending& cost_;
    File file_;
    uint32_t material_ = 0, smoothing_ = 0;
    std::unordered_map<std::string, uint32_t> material_indices_;
};

void Reader::read_vertex(Words& words) {
    std::array<double, 8> numbers;
    size_t count = 0;
    for (std::string_view word = words.next(); !word.empty() && count < numbers.size();
         word = words.next())
        numbers[count++] = text::number(word).value_or(NOT_A_NUMBER);
    std::fill(numbers.begin() + std::ptrdiff_t(count), numbers.end(), NOT_A_NUMBER);
    file_.positions.emplace_back(numbers[0], numbers[1], numbers[2]);
    // A fourth number is a weight, which only curves and surfaces use; a colour may follow.
    const size_t color = count == 6 ? 3 : 4;
    const bool colored = count == 6 || count == 7;
    if (colored && file_.colors.empty()) file_.colors.resize(file_.positions.size() - 1, NO_COLOR);
    if (colored || !file_.colors.empty())
        file_.colors.emplace_back(
            colored ? glm::vec3(numbers[color], numbers[color + 1], numbers[color + 2]) : NO_COLOR);
}

int32_t Reader::read_index(std::string_view digits, size_t count, std::string_view word) const {
    if (digits.starts_with('+')) digits.remove_prefix(1);
    int32_t index = 0;
    const char* end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, index);
    if (error != std::errc() || stop != end)
        throw InputError("{}:{}: '{}' is not a corner; write v, v/vt, v//vn or v/vt/vn", name_,
                         lines_.number(), quoted(word));
    if (index < 0 && size_t(-int64_t(index)) > count)
        throw InputError("{}:{}: '{}' counts back beyond the first of {}; export it again", name_,
                         lines_.number(), quoted(word), count);
    return index < 0 ? int32_t(int64_t(count) + index) : index - 1; // 0 becomes NONE
}

/// v, v/vt, v//vn or v/vt/vn, where what follows a slash may be missing.
Corner Reader::read_corner(std::string_view word) const {
    const size_t counts[] = {file_.positions.size(), file_.uvs.size(), file_.normals.size()};
    int32_t indices[] = {NONE, NONE, NONE};
    std::string_view rest = word;
    for (size_t i = 0; i < 3 && !rest.empty(); ++i) {
        const std::string_view digits = rest.substr(0, rest.find('/'));
        if (i == 0 || !digits.empty()) indices[i] = read_index(digits, counts[i], word);
        rest.remove_prefix(std::min(digits.size() + 1, rest.size()));
    }
    if (indices[0] == NONE || !rest.empty())
        throw InputError("{}:{}: '{}' is not a corner; vertices count from 1", name_,
                         lines_.number(), quoted(word));
    return {indices[0], indices[1], indices[2]};
}

void Reader::read_face(Words& words) {
    const size_t first = file_.corners.size();
    for (std::string_view word = words.next(); !word.empty(); word = words.next())
        file_.corners.push_back(read_corner(word));
    if (file_.corners.size() > MAX_CORNERS)
        throw InputError("{}: more than {} corners; split the file", name_, MAX_CORNERS);
    if (file_.corners.size() - first < 3) {
        file_.corners.resize(first);
        notes_.wrong("Faces of fewer than three corners are skipped",
                     fmt::format("line {}", lines_.number()));
        return;
    }
    file_.faces.push_back({first, uint32_t(lines_.number()), material_, smoothing_});
}

void Reader::read_smoothing(Words& words) {
    const std::string_view word = words.next();
    if (word == "off") {
        smoothing_ = 0;
        return;
    }
    const char* end = word.data() + word.size();
    if (word == "on" || std::from_chars(word.data(), end, smoothing_).ptr != end || word.empty())
        smoothing_ = 1;
}

void Reader::read_material(Words& words) {
    const std::string name(words.rest());
    const auto [found, is_new] =
        material_indices_.try_emplace(name, uint32_t(file_.material_names.size()));
    if (is_new) file_.material_names.push_back(name);
    material_ = found->second;
}

void Reader::read_statement(Words words) {
    const std::string_view keyword = words.next();
    if (keyword.empty() || keyword == "g" || keyword == "o") return;
    if (keyword == "v") return read_vertex(words);
    if (keyword == "f" || keyword == "fo") return read_face(words);
    if (keyword == "s") return read_smoothing(words);
    if (keyword == "usemtl") return read_material(words);
    if (keyword == "vn") {
        const double x = words.next_number(), y = words.next_number(), z = words.next_number();
        file_.normals.emplace_back(x, y, z);
    } else if (keyword == "vt") {
        const double u = words.next_number();
        const std::string_view v = words.next(); // may be missing in one-dimensional textures
        file_.uvs.emplace_back(u, v.empty() ? 0.0 : text::number(v).value_or(NOT_A_NUMBER));
    } else if (keyword == "mtllib") {
        file_.libraries.emplace_back(words.rest());
    } else if (keyword == "l" || keyword == "p") {
        notes_.add("Points and lines are skipped", fmt::format("line {}", lines_.number()));
    } else {
        notes_.add("Statements that are not of polygons are skipped", quoted(keyword));
    }
}

void Reader::check_index(const Face& face, int32_t index, size_t count, const char* kind) const {
    if (index != NONE && size_t(index) >= count)
        throw InputError("{}:{}: a face names {} {}, but there are {}; export it again", name_,
                         face.line, kind, int64_t(index) + 1, count);
}

/// At the end, since faces may stand before the vertices that they name.
void Reader::check_indices() const {
    for (size_t i = 0; i < file_.faces.size(); ++i)
        for (const Corner& corner : file_.corners_of(i)) {
            check_index(file_.faces[i], corner.position, file_.positions.size(), "vertex");
            check_index(file_.faces[i], corner.uv, file_.uvs.size(), "texture vertex");
            check_index(file_.faces[i], corner.normal, file_.normals.size(), "normal");
        }
}

File Reader::read() {
    file_.material_names.emplace_back();
    material_indices_[""] = 0;
    while (const auto line = lines_.next()) {
        const uint64_t before = bytes_of(file_);
        read_statement(Words(*line));
        cost_.add(bytes_of(file_) - before);
        if (std::max({file_.positions.size(), file_.uvs.size(), file_.normals.size()}) >
            MAX_VERTICES)
            throw InputError("{}: more than {} vertices; split the file", name_, MAX_VERTICES);
    }
    check_indices();
    return std::move(file_);
}

} // namespace

template <class T>
static uint64_t bytes_in(const std::vector<T>& elements) {
    return elements.size() * sizeof(T);
}

uint64_t bytes_of(const File& file) {
    return bytes_in(file.positions) + bytes_in(file.colors) + bytes_in(file.normals) +
           bytes_in(file.uvs) + bytes_in(file.corners) + bytes_in(file.faces);
}

File read(const std::string& name, std::string_view text, Notes& notes, GradualSpending& cost) {
    return Reader(name, text, notes, cost).read();
}

} // namespace onde::obj
