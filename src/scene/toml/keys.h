// The keys of shapes, lights and includes in Onde's scene format that are not members of what a
// scene holds: a loader makes geometry and transforms of them.
#pragma once

#include "core/enum_words.h"
#include "scene/chapter_scene.h"
#include "scene/fields.h"
#include "scene/geometry.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/settings.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>

namespace onde::toml_keys {

/// [film]
struct Film {
    std::optional<glm::uvec2> size;
};

constexpr auto fields_of(TypeTag<Film>) {
    return std::tuple{
        field("size", &Film::size, "width and height in pixels", {.range = FILM_SIZE})};
}

/// A texture of a material, where more is said of it than its file.
struct TextureFile {
    std::string file;
    std::optional<Wrap> wrap;
    TextureFilter filter = TextureFilter::linear;
    uint32_t uv_set = 0;
    glm::vec2 offset{0.0f};
    float rotation = 0.0f;
    glm::vec2 scale{1.0f};
};

constexpr auto fields_of(TypeTag<TextureFile>) {
    using T = TextureFile;
    return std::tuple{
        field("file", &T::file, "an image", {.required = true}),
        field("wrap", &T::wrap, "beyond its edges", {.absent = "the material's"}),
        field("filter", &T::filter,
              "between texels; `mip` takes coarser ones where many lie in a pixel"),
        field("uv_set", &T::uv_set, "of the mesh's sets of texture coordinates, from 0",
              {.range = {.low = 0, .high = 255}}),
        field("scale", &T::scale, "of the texture coordinates: the picture repeats so often"),
        field("rotation", &T::rotation,
              "of the scaled coordinates, counter-clockwise in the "
              "picture",
              {.form = Form::degrees}),
        field("offset", &T::offset, "added last")};
}

/// Scale first, then rotation about X, Y and Z, then position.
struct Placement {
    glm::vec3 position{0.0f}, rotation{0.0f}, scale{1.0f};
};

constexpr auto fields_of(TypeTag<Placement>) {
    return std::tuple{
        field("position", &Placement::position, "", {.form = Form::point}),
        field("rotation", &Placement::rotation, "about X, then Y, then Z", {.form = Form::degrees}),
        field("scale", &Placement::scale, "none of them 0", {.form = Form::color}),
        LoaderKey{"motion", "tables", "where it is in time, see [motion](#motion)", "none"}};
}

enum class ShapeType {
    sphere,
    rectangle,
    box,
    plane,
    disk,
    cylinder,
    cone,
    torus,
    ellipsoid,
    mesh
};

constexpr auto enum_words(ShapeType) {
    using S = ShapeType;
    return std::array{EnumWord{S::sphere, "sphere"},
                      EnumWord{S::rectangle, "rectangle"},
                      EnumWord{S::box, "box"},
                      EnumWord{S::plane, "plane"},
                      EnumWord{S::disk, "disk"},
                      EnumWord{S::cylinder, "cylinder"},
                      EnumWord{S::cone, "cone"},
                      EnumWord{S::torus, "torus"},
                      EnumWord{S::ellipsoid, "ellipsoid"},
                      EnumWord{S::mesh, "mesh"}};
}

/// [[shape]], whatever its type.
struct Shape {
    ShapeType type = ShapeType::sphere;
    std::string material, name;
};

constexpr auto fields_of(TypeTag<Shape>) {
    return std::tuple{field("type", &Shape::type, "see below", {.required = true}),
                      field("material", &Shape::material, "the name of a `[[material]]`",
                            {.absent = "diffuse grey 0.8"}),
                      field("name", &Shape::name, "for `--aov crypto-object`",
                            {.absent = "its mesh's, or `object` and a number"})};
}

struct Rectangle {
    std::optional<glm::vec3> corner, edge1, edge2;
    glm::vec2 size{1.0f};
};

constexpr auto fields_of(TypeTag<Rectangle>) {
    return std::tuple{field("corner", &Rectangle::corner, "", {.form = Form::point}),
                      field("edge1", &Rectangle::edge1, ""), field("edge2", &Rectangle::edge2, ""),
                      field("size", &Rectangle::size, "", {.range = POSITIVE})};
}

struct Box {
    glm::vec3 size{1.0f};
};

constexpr auto fields_of(TypeTag<Box>) {
    return std::tuple{field("size", &Box::size, "", {.range = POSITIVE, .form = Form::color})};
}

struct Plane {
    float size = 1000.0f;
};

constexpr auto fields_of(TypeTag<Plane>) {
    return std::tuple{field("size", &Plane::size, "", {.range = POSITIVE})};
}

struct Disk {
    float radius = 1.0f;
};

constexpr auto fields_of(TypeTag<Disk>) {
    return std::tuple{field("radius", &Disk::radius, "", {.range = POSITIVE})};
}

/// Of cylinders and cones.
struct Round {
    float radius = 1.0f, height = 1.0f;
};

constexpr auto fields_of(TypeTag<Round>) {
    return std::tuple{field("radius", &Round::radius, "", {.range = POSITIVE}),
                      field("height", &Round::height, "", {.range = POSITIVE})};
}

struct Torus {
    float major_radius = 1.0f;
    std::optional<float> minor_radius;
};

constexpr auto fields_of(TypeTag<Torus>) {
    return std::tuple{field("major_radius", &Torus::major_radius, "", {.range = POSITIVE}),
                      field("minor_radius", &Torus::minor_radius, "",
                            {.range = POSITIVE, .absent = "a quarter of `major_radius`"})};
}

struct Ellipsoid {
    glm::vec3 radii{1.0f};
};

constexpr auto fields_of(TypeTag<Ellipsoid>) {
    return std::tuple{
        field("radii", &Ellipsoid::radii, "", {.range = POSITIVE, .form = Form::color})};
}

struct MeshFile {
    std::string file;
};

constexpr auto fields_of(TypeTag<MeshFile>) {
    return std::tuple{field("file", &MeshFile::file, "", {.absent = "`positions` and `triangles`"}),
                      LoaderKey{"positions", "`[[x, y, z], ...]`", "", ""},
                      LoaderKey{"triangles", "`[[i, j, k], ...]`", "", ""}};
}

enum class LightType { point, spot, photometric, directional, rectangle, disk, sphere };

constexpr auto enum_words(LightType) {
    using L = LightType;
    return std::array{EnumWord{L::point, "point"},
                      EnumWord{L::spot, "spot"},
                      EnumWord{L::photometric, "photometric"},
                      EnumWord{L::directional, "directional"},
                      EnumWord{L::rectangle, "rectangle"},
                      EnumWord{L::disk, "disk"},
                      EnumWord{L::sphere, "sphere"}};
}

/// [[light]], whatever its type.
struct Light {
    LightType type = LightType::point;
};

constexpr auto fields_of(TypeTag<Light>) {
    return std::tuple{field("type", &Light::type, "see below", {.required = true})};
}

/// What the chapter adds to lights without geometry; AreaLight has its own.
struct ChapterLight {
    glm::vec3 intensity{0.0f};
};

constexpr auto fields_of(TypeTag<ChapterLight>) {
    return std::tuple{
        field("chapter_intensity", &ChapterLight::intensity, "intensity times colour, for Whitted",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = "from the other"})};
}

/// What geometry that is a light emits.
struct Emission {
    glm::vec3 radiance{0.0f};
    std::string group{};
};

constexpr auto fields_of(TypeTag<Emission>) {
    return std::tuple{
        field("radiance", &Emission::radiance, "W/(sr m^2)",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = "from `chapter_intensity`"}),
        field("group", &Emission::group, GROUP_MEANING, GROUP_RULES)};
}

/// From which faces, where there are two.
struct Faces {
    bool two_sided = false;
};

constexpr auto fields_of(TypeTag<Faces>) {
    return std::tuple{field("two_sided", &Faces::two_sided, "whether the back emits as well")};
}

/// Calls visit(meaning, tags...) with the tables of keys that a type of shape has beside Shape's.
template <class Visit>
auto visit_keys(ShapeType type, const Visit& visit) {
    using P = TypeTag<Placement>;
    switch (type) {
    case ShapeType::sphere:
        return visit("", TypeTag<onde::Sphere>{});
    case ShapeType::rectangle:
        return visit("by `corner` and edges, with its front where edge1 x edge2 points; or placed "
                     "by `size`: centred, in the XY plane, front toward +Z",
                     TypeTag<Rectangle>{}, P{});
    case ShapeType::box:
        return visit("centred on its position", TypeTag<Box>{}, P{});
    case ShapeType::plane:
        return visit("a big square in the XZ plane, front toward +Y", TypeTag<Plane>{}, P{});
    case ShapeType::disk:
        return visit("in the XZ plane, front toward +Y", TypeTag<Disk>{}, P{});
    case ShapeType::cylinder:
        return visit("closed, about the Y axis, centred on its position", TypeTag<Round>{}, P{});
    case ShapeType::cone:
        return visit("closed, its base on its position, its tip toward +Y", TypeTag<Round>{}, P{});
    case ShapeType::torus:
        return visit("about the Y axis; `minor_radius` is below `major_radius`", TypeTag<Torus>{},
                     P{});
    case ShapeType::ellipsoid:
        return visit("centred on its position", TypeTag<Ellipsoid>{}, P{});
    case ShapeType::mesh:
        break;
    }
    return visit("a `file` (`.obj`, `.ply`, `.stl`, `.gltf`, `.glb`: geometry only, with the "
                 "file's materials unless `material` is given), or `positions` and `triangles` "
                 "(counter-clockwise from the front, indices from 0, flat shading)",
                 TypeTag<MeshFile>{}, P{});
}

/// The same for a type of light.
template <class Visit>
auto visit_keys(LightType type, const Visit& visit) {
    using P = TypeTag<Placement>;
    using E = TypeTag<Emission>;
    using A = TypeTag<AreaLight>;
    switch (type) {
    case LightType::point:
        return visit("", TypeTag<PointLight>{}, TypeTag<ChapterLight>{});
    case LightType::spot:
        return visit("", TypeTag<SpotLight>{});
    case LightType::photometric:
        return visit("shines as a file says that measures a lamp: straight down, unless "
                     "`direction` is given",
                     TypeTag<PhotometricLight>{});
    case LightType::directional:
        return visit("", TypeTag<DirectionalLight>{}, TypeTag<ChapterLight>{});
    case LightType::rectangle:
        return visit("the rectangle of the same name; its front emits", TypeTag<Rectangle>{}, P{},
                     TypeTag<Faces>{}, E{}, A{});
    case LightType::disk:
        return visit("the disk of the same name; its front emits", TypeTag<Disk>{}, P{},
                     TypeTag<Faces>{}, E{}, A{});
    case LightType::sphere:
        break;
    }
    return visit("", TypeTag<onde::Sphere>{}, E{}, A{});
}

/// All keys of a shape or a light of that type.
template <class Own, class Type>
std::vector<std::string_view> keys_of_type(Type type) {
    return visit_keys(type, []<class... Keys>(std::string_view, TypeTag<Keys>...) {
        return keys_of<Own, Keys...>();
    });
}

inline std::vector<std::string_view> keys_of_shape(ShapeType type) {
    return keys_of_type<Shape>(type);
}

inline std::vector<std::string_view> keys_of_light(LightType type) {
    return keys_of_type<Light>(type);
}

/// [[include]]
struct Include {
    std::string file;
};

constexpr auto fields_of(TypeTag<Include>) {
    return std::tuple{field("file", &Include::file, "a scene or model", {.required = true})};
}

} // namespace onde::toml_keys
