// Shapes, lights and includes of Onde's scene format.
#include "core/error.h"
#include "scene/loaders.h"
#include "scene/shapes.h"
#include "scene/toml_scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde {
namespace fs = std::filesystem;

uint32_t TomlScene::default_material() {
    if (default_material_ < 0) {
        default_material_ = int64_t(scene_.materials.size());
        scene_.materials.emplace_back().name = "default";
    }
    return uint32_t(default_material_);
}

uint32_t TomlScene::material_named_in(const TableReader& table) {
    const auto name = table.text("material");
    if (!name) return default_material();
    const auto found = material_of_name_.find(*name);
    if (found != material_of_name_.end()) return found->second;
    std::string known;
    for (const auto& [other, index] : material_of_name_)
        known += (known.empty() ? "" : ", ") + other;
    table.fail("material",
               fmt::format("names '{}', which is no [[material]] of this file; there is: {}", *name,
                           known.empty() ? "none" : known));
}

/// Scale first, then rotation about X, Y and Z, then position.
glm::mat4 TomlScene::placement(const TableReader& table) const {
    const glm::vec3 position = table.vector("position").value_or(glm::vec3(0.0f));
    const glm::vec3 angles = glm::radians(table.vector("rotation").value_or(glm::vec3(0.0f)));
    const glm::vec3 scale = table.color("scale", ANY_NUMBER).value_or(glm::vec3(1.0f));
    if (!std::isnormal(scale.x * scale.y * scale.z))
        table.fail("scale", "must not be 0 along any axis, nor extreme");
    glm::mat4 m = glm::translate(glm::mat4(1.0f), position);
    m = glm::rotate(m, angles.z, glm::vec3(0, 0, 1));
    m = glm::rotate(m, angles.y, glm::vec3(0, 1, 0));
    m = glm::rotate(m, angles.x, glm::vec3(1, 0, 0));
    return glm::scale(m, scale);
}

void TomlScene::add_baked(Mesh mesh, const glm::mat4& transform) {
    bake(mesh, transform);
    scene_.instances.push_back({uint32_t(scene_.meshes.size()), glm::mat4(1.0f)});
    scene_.meshes.push_back(std::move(mesh));
}

void TomlScene::add_sphere(const TableReader& table, uint32_t material) {
    const glm::vec3 center = table.vector("center").value_or(glm::vec3(0.0f));
    const float radius = table.number("radius", POSITIVE).value_or(1.0f);
    scene_.spheres.push_back({center, radius, material});
}

/// A canonical shape, first scaled by `size`.
void TomlScene::add_placed(const TableReader& table, Shape shape, const glm::vec3& size) {
    shape.object_to_world = glm::scale(placement(table), size);
    if (!std::isnormal(glm::determinant(glm::mat3(shape.object_to_world))))
        table.fail("scale", "makes the shape too small or too large");
    scene_.shapes.push_back(shape);
}

void TomlScene::add_disk(const TableReader& table, uint32_t material) {
    const float radius = table.number("radius", POSITIVE).value_or(1.0f);
    add_placed(table, {.kind = ShapeKind::disk, .material = material},
               glm::vec3(radius, 1.0f, radius));
}

void TomlScene::add_rectangle(const TableReader& table, uint32_t material) {
    if (!table.has("corner")) {
        for (const char* key : {"edge1", "edge2"})
            if (table.has(key)) table.fail(key, "goes with corner; add corner");
        const auto size = table.numbers("size", 2, POSITIVE).value_or(std::vector{1.0f, 1.0f});
        const glm::vec3 corner(-0.5f * size[0], -0.5f * size[1], 0.0f);
        add_baked(
            rectangle_mesh(corner, glm::vec3(size[0], 0, 0), glm::vec3(0, size[1], 0), material),
            placement(table));
        return;
    }
    for (const char* key : {"position", "rotation", "scale", "size"})
        if (table.has(key)) table.fail(key, "can't go with corner; use corner, edge1 and edge2");
    const glm::vec3 corner = *table.vector("corner");
    const glm::vec3 edge1 = table.require("edge1", table.vector("edge1"));
    const glm::vec3 edge2 = table.require("edge2", table.vector("edge2"));
    if (glm::length(glm::cross(glm::dvec3(edge1), glm::dvec3(edge2))) == 0.0)
        table.fail("edge2", "must not be zero or parallel to edge1");
    add_baked(rectangle_mesh(corner, edge1, edge2, material), glm::mat4(1.0f));
}

Mesh TomlScene::inline_mesh(const TableReader& table, uint32_t material) const {
    Mesh mesh;
    mesh.name = "mesh";
    for (const glm::dvec3& position : table.rows("positions"))
        mesh.positions.push_back(glm::vec3(position));
    const double count = double(mesh.positions.size());
    for (const glm::dvec3& row : table.rows("triangles")) {
        for (size_t i = 0; i < 3; ++i)
            if (row[i] < 0.0 || row[i] >= count || row[i] != std::floor(row[i]))
                table.fail("triangles", fmt::format("has the index {}, but there are {} positions",
                                                    row[i], mesh.positions.size()));
        mesh.triangles.push_back(glm::uvec3(row));
    }
    mesh.materials.assign(mesh.triangles.size(), material);
    return mesh;
}

void TomlScene::add_mesh_file(const TableReader& table) {
    for (const char* key : {"positions", "triangles"})
        if (table.has(key)) table.fail(key, "can't go with file; give one of them");
    const std::string file = *table.text("file");
    if (fs::path(file).extension() == ".toml")
        table.fail("file", "must be a .obj, .ply, .gltf or .glb; include scenes by [[include]]");
    const int64_t material = table.has("material") ? int64_t(material_named_in(table)) : -1;
    place(table, "file", file, part(table, "file", file, true, material), placement(table));
}

enum class ShapeType {
    sphere,
    rectangle,
    box,
    plane,
    mesh,
    disk,
    cylinder,
    cone,
    torus,
    ellipsoid
};

constexpr auto enum_words(ShapeType) {
    return std::array{
        EnumWord{ShapeType::sphere, "sphere"},     EnumWord{ShapeType::rectangle, "rectangle"},
        EnumWord{ShapeType::box, "box"},           EnumWord{ShapeType::plane, "plane"},
        EnumWord{ShapeType::mesh, "mesh"},         EnumWord{ShapeType::disk, "disk"},
        EnumWord{ShapeType::cylinder, "cylinder"}, EnumWord{ShapeType::cone, "cone"},
        EnumWord{ShapeType::torus, "torus"},       EnumWord{ShapeType::ellipsoid, "ellipsoid"}};
}

void TomlScene::read_shape(const TableReader& table) {
    switch (const ShapeType type = table.require("type", table.choice<ShapeType>("type"))) {
    case ShapeType::sphere:
        table.allow({"type", "material", "center", "radius"});
        return add_sphere(table, material_named_in(table));
    case ShapeType::rectangle:
        table.allow({"type", "material", "position", "rotation", "scale", "size", "corner", "edge1",
                     "edge2"});
        return add_rectangle(table, material_named_in(table));
    case ShapeType::box: {
        table.allow({"type", "material", "position", "rotation", "scale", "size"});
        const glm::vec3 size = table.color("size", POSITIVE).value_or(glm::vec3(1.0f));
        return add_baked(box_mesh(size, material_named_in(table)), placement(table));
    }
    case ShapeType::plane: {
        table.allow({"type", "material", "position", "rotation", "scale", "size"});
        const float size = table.number("size", POSITIVE).value_or(1000.0f);
        const glm::vec3 corner(-0.5f * size, 0.0f, 0.5f * size), x(size, 0, 0),
            minus_z(0, 0, -size);
        return add_baked(rectangle_mesh(corner, x, minus_z, material_named_in(table)),
                         placement(table));
    }
    case ShapeType::disk:
        table.allow({"type", "material", "position", "rotation", "scale", "radius"});
        return add_disk(table, material_named_in(table));
    case ShapeType::cylinder:
    case ShapeType::cone: {
        table.allow({"type", "material", "position", "rotation", "scale", "radius", "height"});
        const float radius = table.number("radius", POSITIVE).value_or(1.0f);
        const float height = table.number("height", POSITIVE).value_or(1.0f);
        const bool cone = type == ShapeType::cone;
        return add_placed(table,
                          {.kind = cone ? ShapeKind::cone : ShapeKind::cylinder,
                           .material = material_named_in(table)},
                          glm::vec3(radius, cone ? height : 0.5f * height, radius));
    }
    case ShapeType::torus: {
        table.allow(
            {"type", "material", "position", "rotation", "scale", "major_radius", "minor_radius"});
        const float major = table.number("major_radius", POSITIVE).value_or(1.0f);
        const float minor = table.number("minor_radius", POSITIVE).value_or(0.25f * major);
        if (!(minor / major < 1.0f && minor / major > 0.0f))
            table.fail("minor_radius", "must be below major_radius");
        return add_placed(table,
                          {.kind = ShapeKind::torus,
                           .material = material_named_in(table),
                           .minor_radius = minor / major},
                          glm::vec3(major));
    }
    case ShapeType::ellipsoid: {
        table.allow({"type", "material", "position", "rotation", "scale", "radii"});
        const glm::vec3 radii = table.color("radii", POSITIVE).value_or(glm::vec3(1.0f));
        return add_placed(table, {.kind = ShapeKind::sphere, .material = material_named_in(table)},
                          radii);
    }
    case ShapeType::mesh:
        table.allow({"type", "material", "position", "rotation", "scale", "file", "positions",
                     "triangles"});
        if (table.text("file")) return add_mesh_file(table);
        add_baked(inline_mesh(table, material_named_in(table)), placement(table));
    }
}

/// Of the keys `strength`, the chapter's measure, and the radiometric one at least one is needed.
struct Measures {
    glm::vec3 strength{0.0f}, radiometric{0.0f};
};

static Measures measures(const TableReader& table, const char* radiometric) {
    if (!table.has("strength") && !table.has(radiometric))
        table.fail(radiometric, "is missing; add it, or strength");
    const glm::vec3 none(0.0f);
    return {table.color("strength", NOT_NEGATIVE).value_or(none),
            table.color(radiometric, NOT_NEGATIVE).value_or(none)};
}

/// A black material that emits the light's radiance.
uint32_t TomlScene::emitter(const TableReader& table) {
    Material material;
    material.name = "light";
    material.base_color = glm::vec3(0.0f);
    material.emission = measures(table, "radiance").radiometric;
    material.two_sided = table.boolean("two_sided").value_or(false);
    scene_.materials.push_back(material);
    return uint32_t(scene_.materials.size() - 1);
}

void TomlScene::add_area_light(const TableReader& table, AreaLight light) {
    light.strength = measures(table, "radiance").strength;
    light.samples = table.integer("samples", 1, 64).value_or(light.samples);
    light.material = uint32_t(scene_.materials.size() - 1);
    light.two_sided = scene_.materials.back().two_sided;
    scene_.area_lights.push_back(light);
}

enum class LightType { point, directional, rectangle, sphere, disk };

constexpr auto enum_words(LightType) {
    return std::array{EnumWord{LightType::point, "point"},
                      EnumWord{LightType::directional, "directional"},
                      EnumWord{LightType::rectangle, "rectangle"},
                      EnumWord{LightType::sphere, "sphere"}, EnumWord{LightType::disk, "disk"}};
}

void TomlScene::read_light(const TableReader& table) {
    const LightType type = table.require("type", table.choice<LightType>("type"));
    if (type == LightType::point) {
        table.allow({"type", "position", "intensity", "strength"});
        const Measures m = measures(table, "intensity");
        scene_.point_lights.push_back(
            {table.require("position", table.vector("position")), m.radiometric, m.strength});
    } else if (type == LightType::directional) {
        table.allow({"type", "direction", "irradiance", "strength"});
        const glm::dvec3 direction(table.require("direction", table.vector("direction")));
        if (glm::length(direction) < 1e-30) table.fail("direction", "must not be zero");
        const Measures m = measures(table, "irradiance");
        scene_.directional_lights.push_back(
            {glm::vec3(-glm::normalize(direction)), m.radiometric, m.strength});
    } else if (type == LightType::rectangle) {
        table.allow({"type", "radiance", "strength", "samples", "two_sided", "position", "rotation",
                     "scale", "size", "corner", "edge1", "edge2"});
        add_rectangle(table, emitter(table));
        const Mesh& mesh = scene_.meshes.back(); // its corners go around
        AreaLight light;
        light.position = mesh.positions[0];
        light.edge1 = mesh.positions[1] - mesh.positions[0];
        light.edge2 = mesh.positions[3] - mesh.positions[0];
        add_area_light(table, light);
    } else if (type == LightType::disk) {
        table.allow({"type", "radiance", "strength", "samples", "two_sided", "position", "rotation",
                     "scale", "radius"});
        add_disk(table, emitter(table));
        const glm::mat4& m = scene_.shapes.back().object_to_world;
        AreaLight light;
        light.kind = AreaLightKind::disk;
        light.position = glm::vec3(m[3]);
        const bool mirrored = glm::determinant(glm::mat3(m)) < 0.0f; // the front stays the front
        light.edge1 = glm::vec3(m[mirrored ? 0 : 2]);
        light.edge2 = glm::vec3(m[mirrored ? 2 : 0]);
        add_area_light(table, light);
    } else {
        table.allow({"type", "radiance", "strength", "samples", "center", "radius"});
        add_sphere(table, emitter(table));
        AreaLight light;
        light.kind = AreaLightKind::sphere;
        light.position = scene_.spheres.back().center;
        light.radius = scene_.spheres.back().radius;
        add_area_light(table, light);
    }
}

static void keep_geometry(Scene& scene) {
    scene.point_lights.clear();
    scene.directional_lights.clear();
    scene.area_lights.clear();
    scene.cameras.clear();
    scene.environment = {};
    scene.settings = {};
    scene.whitted = {};
}

TomlScene::Part& TomlScene::part(const TableReader& table, std::string_view key,
                                 const std::string& file, bool geometry_only, int64_t material) {
    const fs::path path = resolve_inside(folder_, file, table.where(key));
    if (!fs::exists(path))
        table.fail(key, fmt::format("names '{}', which does not exist; check the name", file));
    const auto [found, is_new] =
        parts_.try_emplace(fmt::format("{} {} {}", geometry_only, material, path.string()));
    Part& part = found->second;
    if (!is_new) return part;
    part.placed = load_part(path, ancestors_);
    if (geometry_only) keep_geometry(part.placed);
    for (const std::string& note : part.placed.notes) scene_.notes.push_back(file + ": " + note);
    part.offsets = append_assets(scene_, part.placed);
    if (material >= 0)
        for (size_t i = part.offsets.meshes; i < scene_.meshes.size(); ++i)
            std::fill(scene_.meshes[i].materials.begin(), scene_.meshes[i].materials.end(),
                      uint32_t(material));
    return part;
}

void TomlScene::place(const TableReader& table, std::string_view key, const std::string& file,
                      const Part& part, const glm::mat4& transform) {
    try {
        append_placed(scene_, part.placed, part.offsets, transform);
    } catch (const InputError& error) {
        throw InputError("{}: '{}': {}", table.where(key), file, error.what());
    }
}

void TomlScene::read_includes(const TableReader& root) {
    if (!root.has("include")) return;
    if (root.is_array_of_texts("include")) {
        for (const std::string& file : root.texts("include"))
            place(root, "include", file, part(root, "include", file, false, -1), glm::mat4(1.0f));
        return;
    }
    for (const TableReader& table : root.tables("include")) {
        table.allow({"file", "position", "rotation", "scale"});
        const std::string file = table.require("file", table.text("file"));
        place(table, "file", file, part(table, "file", file, false, -1), placement(table));
    }
}

} // namespace onde
