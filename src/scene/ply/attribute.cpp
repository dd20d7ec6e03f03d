#include "scene/mesh_attribute.h"

#include "scene/mesh_parts.h"
#include "scene/ply/body.h"
#include "scene/ply/words.h"

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

/// Which number of the attribute a property is: 1 of "color_1" for "color"; nothing for another.
std::optional<size_t> component(const ply::Property& property, std::string_view attribute) {
    constexpr size_t MOST = 3;
    for (size_t i = 0; i < MOST; ++i)
        if (!property.count_type && property.name == fmt::format("{}_{}", attribute, i)) return i;
    return std::nullopt;
}

class AttributeReader {
  public:
    AttributeReader(const std::string& name, std::string_view file, const MeshAttribute& attribute)
        : header_(ply::read_header(name, file)),
          body_(name, file.substr(header_.size), header_.encoding), attribute_(attribute) {}

    /// The colour of each row of the element; none where it lacks the attribute.
    std::vector<glm::vec4> read(std::string_view wanted, std::string_view attribute) {
        for (const ply::Element& element : header_.elements) {
            if (element.name == wanted) return read_rows(element, attribute);
            body_.skip(element);
        }
        return {};
    }

  private:
    std::vector<glm::vec4> read_rows(const ply::Element& element, std::string_view attribute) {
        const auto components =
            std::ranges::count_if(element.properties, [&](const ply::Property& property) {
                return component(property, attribute).has_value();
            });
        if (components != 1 && components != 3) return {};
        body_.begin(element);
        std::vector<glm::vec4> colors;
        for (uint64_t row = 0; row < element.count; ++row) {
            body_.begin_row(row);
            colors.push_back(color(read_row(element, attribute), components == 1));
        }
        return colors;
    }

    glm::dvec3 read_row(const ply::Element& element, std::string_view attribute) {
        glm::dvec3 numbers{0.0};
        for (const ply::Property& property : element.properties)
            if (const auto i = component(property, attribute))
                numbers[glm::length_t(*i)] = body_.number(property);
            else
                body_.skip(property);
        return numbers;
    }

    glm::vec4 color(const glm::dvec3& numbers, bool is_weight) const {
        glm::vec3 share(is_weight ? glm::dvec3(numbers.x) : numbers);
        for (glm::length_t c = 0; c < 3; ++c)
            share[c] = std::isfinite(share[c]) ? std::clamp(share[c], 0.0f, 1.0f) : 0.0f;
        return {glm::mix(attribute_.at_zero, attribute_.at_one, share), 1.0f};
    }

    const ply::Header header_;
    ply::Body body_;
    const MeshAttribute& attribute_;
};

template <class T>
void take_apart(std::vector<T>& values, const std::vector<glm::uvec3>& triangles) {
    if (values.empty()) return;
    std::vector<T> apart;
    apart.reserve(3 * triangles.size());
    for (const glm::uvec3& triangle : triangles)
        for (glm::length_t corner = 0; corner < 3; ++corner)
            apart.push_back(values[triangle[corner]]);
    values = std::move(apart);
}

/// Gives each triangle vertices of its own.
void take_apart(Mesh& mesh) {
    take_apart(mesh.positions, mesh.triangles);
    take_apart(mesh.normals, mesh.triangles);
    take_apart(mesh.uvs, mesh.triangles);
    mesh.more_uvs.clear();
    mesh.tangents.clear();
    for (size_t i = 0; i < mesh.triangles.size(); ++i)
        mesh.triangles[i] = glm::uvec3(0, 1, 2) + uint32_t(3 * i);
}

} // namespace

bool color_by(Mesh& mesh, const std::filesystem::path& file, const MeshAttribute& attribute,
              LoadContext& context) {
    constexpr std::string_view VERTEX = "vertex_", FACE = "face_";
    const bool is_of_faces = attribute.name.starts_with(FACE);
    if (!is_of_faces && !attribute.name.starts_with(VERTEX)) return false;
    const std::string name = file.string(), bytes = read_file_within(context, file);
    const auto wanted =
        std::string_view(attribute.name).substr((is_of_faces ? FACE : VERTEX).size());
    std::vector<glm::vec4> colors =
        AttributeReader(name, bytes, attribute).read(is_of_faces ? ply::FACE : ply::VERTEX, wanted);
    const size_t needed = is_of_faces ? mesh.triangles.size() : mesh.positions.size();
    if (colors.empty() || colors.size() != needed) return false;
    if (is_of_faces) {
        context.spend(3 * mesh.triangles.size(), VERTEX_BYTES, name);
        const std::vector<glm::vec4> of_faces = std::move(colors);
        colors.clear();
        for (const glm::vec4& color : of_faces) colors.insert(colors.end(), 3, color);
        take_apart(mesh);
    }
    mesh.colors = std::move(colors);
    return true;
}

} // namespace onde
