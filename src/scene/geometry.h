// What rays can meet, in object or world space.
#pragma once

#include "core/enum_words.h"
#include "scene/fields.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace onde {

/// Triangles in object space. Counter-clockwise seen from the front face.
struct Mesh {
    std::string name;
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals; ///< per vertex, unit; empty means flat shading
    std::vector<glm::vec2> uvs;     ///< per vertex, v downward as in glTF; may be empty
    std::vector<std::vector<glm::vec2>> more_uvs; ///< further sets, from set 1; each may be empty
    std::vector<glm::vec4> colors;   ///< per vertex, linear, 0 to 1; they multiply the base colour
                                     ///< and its alpha; may be empty
    std::vector<glm::vec4> tangents; ///< per vertex, unit, w the sign of the bitangent, as in glTF;
                                     ///< zero where it is to be computed; may be empty
    std::vector<glm::uvec3> triangles;
    std::vector<uint32_t> materials; ///< one per triangle
};

/// The texture coordinates of a set; empty where the mesh has none.
inline const std::vector<glm::vec2>& uv_set(const Mesh& mesh, uint32_t set) {
    static const std::vector<glm::vec2> NONE;
    if (set == 0) return mesh.uvs;
    return set <= mesh.more_uvs.size() ? mesh.more_uvs[set - 1] : NONE;
}

/// What a thing is called, and what it came with: an included file, or the topmost node of one.
struct PlacedName {
    std::string object, asset; ///< either may be empty
};

/// A mesh placed in the world. The transform is affine and invertible.
struct Instance {
    uint32_t mesh = 0;
    glm::mat4 object_to_world{1.0f};
    uint32_t name = NO_NAME;
};

constexpr auto fields_of(TypeTag<Instance>) {
    return std::tuple{field_without_key(&Instance::mesh, "mesh"),
                      field_without_key(&Instance::object_to_world, "transform"),
                      field_without_key(&Instance::name, "name", {.form = Form::name})};
}

/// An analytic sphere in world space.
struct Sphere {
    glm::vec3 center{0.0f};
    float radius = 1.0f;
    uint32_t material = 0;
    uint32_t name = NO_NAME;
};

constexpr auto fields_of(TypeTag<Sphere>) {
    return std::tuple{field("center", &Sphere::center, "", {.form = Form::point}),
                      field("radius", &Sphere::radius, "", {.range = POSITIVE}),
                      field_without_key(&Sphere::material, "material", {.form = Form::material}),
                      field_without_key(&Sphere::name, "name", {.form = Form::name}),
                      LoaderKey{"motion", "tables",
                                "where its centre is in time, see [motion](#motion)", "none"}};
}

enum class ShapeKind : uint32_t { sphere, disk, cylinder, cone, torus };

constexpr auto enum_words(ShapeKind) {
    return std::array{EnumWord{ShapeKind::sphere, "sphere"}, EnumWord{ShapeKind::disk, "disk"},
                      EnumWord{ShapeKind::cylinder, "cylinder"}, EnumWord{ShapeKind::cone, "cone"},
                      EnumWord{ShapeKind::torus, "torus"}};
}

/// An analytic shape: a canonical one in object space, placed by an affine, invertible transform.
/// sphere: radius 1 about the origin. disk: radius 1 in the XZ plane, front toward +Y.
/// cylinder: radius 1 about the Y axis, y in [-1, 1]. cone: base of radius 1 at y = 0, tip at
/// y = 1. torus: about the Y axis, major radius 1. Cylinder and cone are closed solids. Front faces
/// look outward.
struct Shape {
    ShapeKind kind = ShapeKind::sphere;
    uint32_t material = 0;
    float minor_radius = 0.25f; ///< torus only, in (0, 1)
    glm::mat4 object_to_world{1.0f};
    uint32_t name = NO_NAME;
};

constexpr auto fields_of(TypeTag<Shape>) {
    return std::tuple{field_without_key(&Shape::kind, "kind"),
                      field_without_key(&Shape::material, "material", {.form = Form::material}),
                      field_without_key(&Shape::minor_radius, "minor radius", {.range = UNIT}),
                      field_without_key(&Shape::object_to_world, "transform"),
                      field_without_key(&Shape::name, "name", {.form = Form::name})};
}

} // namespace onde
