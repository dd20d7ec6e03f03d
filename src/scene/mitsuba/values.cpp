#include "scene/mitsuba/values.h"

#include "core/error.h"
#include "scene/text.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace onde::mitsuba {
namespace {

struct Substance {
    std::string_view name;
    double index;
};
/// As Mitsuba's documentation lists them.
constexpr Substance SUBSTANCES[] = {
    {"vacuum", 1.0},      {"helium", 1.000036},        {"hydrogen", 1.000132},
    {"air", 1.000277},    {"carbon dioxide", 1.00045}, {"water", 1.333},
    {"acetone", 1.36},    {"ethanol", 1.361},          {"carbon tetrachloride", 1.461},
    {"glycerol", 1.4729}, {"benzene", 1.501},          {"silicone oil", 1.52045},
    {"bromine", 1.661},   {"water ice", 1.31},         {"fused quartz", 1.458},
    {"pyrex", 1.47},      {"acrylic glass", 1.49},     {"polypropylene", 1.49},
    {"bk7", 1.5046},      {"sodium chloride", 1.544},  {"amber", 1.55},
    {"pet", 1.575},       {"diamond", 2.419}};

std::optional<double> substance_index(std::string_view name) {
    const auto found = std::ranges::find(SUBSTANCES, name, &Substance::name);
    if (found == std::end(SUBSTANCES)) return std::nullopt;
    return found->index;
}

bool all_finite(const std::vector<double>& numbers) {
    return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

/// Three numbers, or one for all.
std::optional<glm::dvec3> triple(const std::vector<double>& numbers) {
    if (!all_finite(numbers)) return std::nullopt;
    if (numbers.size() == 1) return glm::dvec3(numbers[0]);
    if (numbers.size() == 3) return glm::dvec3(numbers[0], numbers[1], numbers[2]);
    return std::nullopt;
}

/// By "value", or by "x", "y" and "z", of which those that are absent are `absent`.
std::optional<glm::dvec3> triple_of(const Element& element, double absent) {
    if (!element["value"].empty()) return triple(numbers_of(element["value"]));
    glm::dvec3 v(absent);
    for (size_t i = 0; i < 3; ++i) {
        const auto numbers = numbers_of(element[std::string_view("xyz").substr(i, 1)]);
        if (numbers.empty()) continue;
        if (!std::isfinite(numbers[0])) return std::nullopt;
        v[i] = numbers[0];
    }
    return v;
}

/// Mitsuba's camera and light space: +X to the left, +Y up, +Z ahead.
std::optional<glm::dmat4> look_at(const Element& element) {
    const auto origin = triple(numbers_of(element["origin"]));
    const auto target = triple(numbers_of(element["target"]));
    const std::string& up_text = element["up"];
    const auto up = up_text.empty() ? glm::dvec3(0, 1, 0) : triple(numbers_of(up_text));
    if (!origin || !target || !up) return std::nullopt;
    const glm::dvec3 ahead = *target - *origin, left = glm::cross(*up, ahead);
    if (!(glm::length(ahead) > 0.0) || !(glm::length(left) > 0.0)) return std::nullopt;
    const glm::dvec3 z = glm::normalize(ahead), x = glm::normalize(left);
    return glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0),
                      glm::dvec4(*origin, 1.0));
}

/// Of 16 numbers, or 9 of a linear one, row by row.
std::optional<glm::dmat4> matrix(const Element& element) {
    const std::vector<double> numbers = numbers_of(element["value"]);
    const size_t side = numbers.size() == 9 ? 3 : 4;
    if (numbers.size() != side * side || !all_finite(numbers)) return std::nullopt;
    glm::dmat4 m(1.0);
    for (size_t i = 0; i < numbers.size(); ++i) m[i % side][i / side] = numbers[i];
    return m;
}

std::optional<glm::dmat4> rotation(const Element& element) {
    const auto axis = triple_of(element, 0.0);
    const auto angle = numbers_of(element["angle"]);
    if (!axis || !(glm::length(*axis) > 0.0) || angle.size() != 1 || !std::isfinite(angle[0]))
        return std::nullopt;
    return glm::rotate(glm::dmat4(1.0), glm::radians(angle[0]), *axis);
}

/// One step of a transform; nothing for what is none.
std::optional<glm::dmat4> step(const Element& element) {
    if (element.tag == "lookat" || element.tag == "look_at") return look_at(element);
    if (element.tag == "matrix") return matrix(element);
    if (element.tag == "rotate") return rotation(element);
    const bool scales = element.tag == "scale";
    if (!scales && element.tag != "translate") return std::nullopt;
    const auto v = triple_of(element, scales ? 1.0 : 0.0);
    if (!v) return std::nullopt;
    return scales ? glm::scale(glm::dmat4(1.0), *v) : glm::translate(glm::dmat4(1.0), *v);
}

} // namespace

std::vector<double> numbers_of(std::string_view text) {
    constexpr std::string_view BETWEEN = " ,\t\r\n";
    std::vector<double> numbers;
    for (size_t at = text.find_first_not_of(BETWEEN); at != std::string_view::npos;
         at = text.find_first_not_of(BETWEEN, at)) {
        const size_t end = std::min(text.find_first_of(BETWEEN, at), text.size());
        numbers.push_back(text::number(text.substr(at, end - at)).value_or(NAN));
        at = end;
    }
    return numbers;
}

void Values::note_wrong(const Element& element) const {
    document_.notes().wrong("Values that are none count as absent",
                            element.where + ": " + element["name"]);
}

std::optional<double> Values::number(std::string_view name) const {
    const Element* found = document_.property(of_, name);
    if (!found) return std::nullopt;
    const bool is_number = found->tag == "float" || found->tag == "integer";
    const auto numbers = numbers_of((*found)["value"]);
    if (is_number && numbers.size() == 1 && std::isfinite(numbers[0])) return numbers[0];
    note_wrong(*found);
    return std::nullopt;
}

bool Values::flag(std::string_view name, bool absent) const {
    const Element* found = document_.property(of_, name);
    if (!found) return absent;
    std::string word = (*found)["value"];
    std::ranges::transform(word, word.begin(), [](unsigned char c) { return std::tolower(c); });
    if (found->tag == "boolean" && (word == "true" || word == "false")) return word == "true";
    note_wrong(*found);
    return absent;
}

std::string Values::text(std::string_view name, const std::string& absent) const {
    const Element* found = document_.property(of_, name);
    if (!found || found->tag == "string") return found ? (*found)["value"] : absent;
    note_wrong(*found);
    return absent;
}

glm::dvec3 Values::vector(std::string_view name, const glm::dvec3& absent) const {
    const Element* found = document_.property(of_, name);
    if (!found) return absent;
    const auto v = triple_of(*found, 0.0);
    if (!v) note_wrong(*found);
    return v.value_or(absent);
}

glm::dmat4 Values::transform(std::string_view name) const {
    glm::dmat4 m(1.0);
    const Element* found = document_.property(of_, name);
    if (!found) return m;
    if (found->tag != "transform") {
        note_wrong(*found);
        return m;
    }
    for (const Element& child : found->children)
        if (const auto by = step(child))
            m = *by * m;
        else
            document_.notes().wrong("Steps of transforms that are none are left out", child.where);
    return m;
}

std::optional<glm::dvec3> Values::spectrum(const Element& element) const {
    const std::string& text = element["value"];
    if (text.find(':') == std::string::npos) return triple(numbers_of(text));
    std::string pairs = text;
    std::ranges::replace(pairs, ':', ' ');
    const auto curve = spectrum::curve_of_pairs(numbers_of(pairs));
    if (!curve) return std::nullopt;
    return spectrum::color_of_light(*curve);
}

std::optional<glm::dvec3> Values::color(std::string_view name) const {
    const Element* found = document_.property(of_, name);
    if (!found || found->tag == "texture") return std::nullopt;
    std::optional<glm::dvec3> color;
    if (found->tag == "spectrum")
        color = spectrum(*found);
    else if (found->tag == "rgb" || found->tag == "float")
        color = triple(numbers_of((*found)["value"]));
    else if (found->tag == "blackbody")
        document_.notes().add("Black bodies are left out", found->where);
    if (!color && found->tag != "blackbody") note_wrong(*found);
    return color;
}

double Values::index(std::string_view name, const char* absent) const {
    const Element* found = document_.property(of_, name);
    const bool is_named = !found || found->tag == "string";
    if (const auto stated = is_named ? std::nullopt : number(name)) return *stated;
    const std::string substance = is_named ? text(name, absent) : absent;
    if (const auto known = substance_index(substance)) return *known;
    document_.notes().wrong("Substances that Mitsuba does not know are bk7", substance);
    return *substance_index("bk7");
}

} // namespace onde::mitsuba
