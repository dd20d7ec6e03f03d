#include "scene/mesh_attribute.h"

#include "scene/ply/body.h"
#include "scene/ply/words.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde {
namespace {

/// Which number of the attribute a property is: 1 of "color_1" for "color"; nothing for another.
std::optional<size_t> component(const ply::Property& property, std::string_view attribute) {
    constexpr size_t MOST = 3;
    for (size_t i = 0; i < MOST; ++i)
        if (!property.count_type && property.name == fmt::format("{}_{}", attribute, i)) return i;
    return std::nullopt;
}

glm::dvec3 read_row(ply::Body& body, const ply::Element& element, std::string_view attribute) {
    glm::dvec3 numbers{0.0};
    for (const ply::Property& property : element.properties)
        if (const auto i = component(property, attribute))
            numbers[glm::length_t(*i)] = body.number(property);
        else
            body.skip(property);
    return numbers;
}

std::vector<glm::dvec3> read_rows(ply::Body& body, const ply::Element& element,
                                  std::string_view attribute) {
    const auto components =
        std::ranges::count_if(element.properties, [&](const ply::Property& property) {
            return component(property, attribute).has_value();
        });
    if (components != 1 && components != 3) return {};
    body.begin(element);
    std::vector<glm::dvec3> rows;
    for (uint64_t row = 0; row < element.count; ++row) {
        body.begin_row(row);
        const glm::dvec3 numbers = read_row(body, element, attribute);
        rows.push_back(components == 1 ? glm::dvec3(numbers.x) : numbers);
    }
    return rows;
}

} // namespace

std::vector<glm::dvec3> ply_attribute(const std::string& name, std::string_view file,
                                      AttributeOf of, std::string_view attribute) {
    const std::string_view wanted = of == AttributeOf::faces ? ply::FACE : ply::VERTEX;
    const ply::Header header = ply::read_header(name, file);
    ply::Body body(name, file.substr(header.size), header.encoding);
    for (const ply::Element& element : header.elements) {
        if (element.name == wanted) return read_rows(body, element, attribute);
        body.skip(element);
    }
    return {};
}

} // namespace onde
