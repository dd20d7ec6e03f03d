// Shapes and lights of Onde's scene format.
#include "scene/shapes.h"
#include "core/error.h"
#include "core/shown.h"
#include "scene/ies.h"
#include "scene/origin.h"
#include "scene/toml/fields.h"
#include "scene/toml/keys.h"
#include "scene/toml/scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>

namespace onde {
namespace fs = std::filesystem;
namespace keys = toml_keys;

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

uint32_t TomlScene::placed_name(const TableReader& table) {
    const auto name = table.text("name");
    if (!name || name->empty()) return NO_NAME;
    const auto [found, is_new] =
        name_of_table_.try_emplace(table.where(), uint32_t(scene_.names.size()));
    if (is_new) scene_.names.push_back({*name, ""});
    return found->second;
}

void TomlScene::add_baked(const TableReader& table, Mesh mesh, const glm::mat4& transform) {
    const auto [found, is_new] =
        mesh_of_table_.try_emplace(table.where(), uint32_t(scene_.meshes.size()));
    if (is_new) scene_.meshes.emplace_back();
    const bool moves = table.has("motion"); // its mesh is the same at all moments
    if (!moves) bake(mesh, transform);
    scene_.instances.push_back(
        {found->second, moves ? transform : glm::mat4(1.0f), placed_name(table)});
    scene_.meshes[found->second] = std::move(mesh);
}

void TomlScene::add_sphere(const TableReader& table, uint32_t material) {
    Sphere sphere{.center = glm::vec3(glm::dvec3(0.0) - table.origin()), .material = material};
    read_fields(table, sphere);
    if (const auto motion = motion_of(table, {"center"}))
        sphere.center = glm::vec3(motion->point("center", glm::dvec3(sphere.center)));
    sphere.name = placed_name(table);
    scene_.spheres.push_back(sphere);
}

/// A canonical shape, first scaled by `size`.
void TomlScene::add_placed(const TableReader& table, Shape shape, const glm::vec3& size) {
    shape.object_to_world = glm::scale(placement(table), size);
    if (!std::isnormal(glm::determinant(glm::mat3(shape.object_to_world))))
        table.fail("scale", "makes the shape too small or too large");
    shape.name = placed_name(table);
    scene_.shapes.push_back(shape);
}

void TomlScene::add_disk(const TableReader& table, uint32_t material) {
    keys::Disk disk;
    read_fields(table, disk);
    add_placed(table, {.kind = ShapeKind::disk, .material = material},
               glm::vec3(disk.radius, 1.0f, disk.radius));
}

void TomlScene::add_round(const TableReader& table, ShapeKind kind, uint32_t material) {
    keys::Round round;
    read_fields(table, round);
    // Canonical cylinders are 2 high.
    const float y = kind == ShapeKind::cone ? round.height : 0.5f * round.height;
    add_placed(table, {.kind = kind, .material = material},
               glm::vec3(round.radius, y, round.radius));
}

void TomlScene::add_torus(const TableReader& table, uint32_t material) {
    keys::Torus torus;
    read_fields(table, torus);
    const float minor =
        torus.minor_radius.value_or(0.25f * torus.major_radius) / torus.major_radius;
    if (!(minor < 1.0f && minor > 0.0f)) table.fail("minor_radius", "must be below major_radius");
    add_placed(table, {.kind = ShapeKind::torus, .material = material, .minor_radius = minor},
               glm::vec3(torus.major_radius));
}

void TomlScene::add_rectangle(const TableReader& table, uint32_t material) {
    keys::Rectangle rectangle;
    read_fields(table, rectangle);
    if (!rectangle.corner) {
        for (const char* key : {"edge1", "edge2"})
            if (table.has(key)) table.fail(key, "goes with corner; add corner");
        const glm::vec3 x(rectangle.size.x, 0, 0), y(0, rectangle.size.y, 0);
        const glm::vec3 corner(-0.5f * x.x, -0.5f * y.y, 0.0f);
        return add_baked(table, rectangle_mesh(corner, x, y, material), placement(table));
    }
    for (const char* key : {"position", "rotation", "scale", "size", "motion"})
        if (table.has(key)) table.fail(key, "can't go with corner; use corner, edge1 and edge2");
    const glm::vec3 edge1 = table.require("edge1", rectangle.edge1);
    const glm::vec3 edge2 = table.require("edge2", rectangle.edge2);
    if (glm::length(glm::cross(glm::dvec3(edge1), glm::dvec3(edge2))) == 0.0)
        table.fail("edge2", "must not be zero or parallel to edge1");
    add_baked(table, rectangle_mesh(*rectangle.corner, edge1, edge2, material), glm::mat4(1.0f));
}

void TomlScene::add_plane(const TableReader& table, uint32_t material) {
    keys::Plane plane;
    read_fields(table, plane);
    const glm::vec3 corner(-0.5f * plane.size, 0.0f, 0.5f * plane.size);
    const glm::vec3 x(plane.size, 0, 0), minus_z(0, 0, -plane.size);
    add_baked(table, rectangle_mesh(corner, x, minus_z, material), placement(table));
}

void TomlScene::add_box(const TableReader& table, uint32_t material) {
    keys::Box box;
    read_fields(table, box);
    add_baked(table, box_mesh(box.size, material), placement(table));
}

void TomlScene::add_ellipsoid(const TableReader& table, uint32_t material) {
    keys::Ellipsoid ellipsoid;
    read_fields(table, ellipsoid);
    add_placed(table, {.kind = ShapeKind::sphere, .material = material}, ellipsoid.radii);
}

void TomlScene::add_inline_mesh(const TableReader& table, uint32_t material) {
    Mesh mesh;
    mesh.name = "mesh";
    const std::vector<glm::dvec3> positions = table.rows("positions");
    Extent extent;
    for (const glm::dvec3& position : positions) extent.grow(position);
    const glm::dvec3 origin = origin_of(extent);
    mesh.positions = counted_from(origin, positions);
    const double count = double(mesh.positions.size());
    for (const glm::dvec3& row : table.rows("triangles")) {
        for (size_t i = 0; i < 3; ++i)
            if (row[i] < 0.0 || row[i] >= count || row[i] != std::floor(row[i]))
                table.fail("triangles", fmt::format("has the index {}, but there are {} positions",
                                                    row[i], mesh.positions.size()));
        mesh.triangles.push_back(glm::uvec3(row));
    }
    mesh.materials.assign(mesh.triangles.size(), material);
    add_baked(table, std::move(mesh), placement(table, origin));
}

void TomlScene::add_mesh(const TableReader& table) {
    keys::MeshFile mesh;
    read_fields(table, mesh);
    if (mesh.file.empty() && !table.has("file"))
        return add_inline_mesh(table, material_named_in(table));
    for (const char* key : {"positions", "triangles"})
        if (table.has(key)) table.fail(key, "can't go with file; give one of them");
    if (fs::path(mesh.file).extension() == ".toml")
        table.fail("file",
                   "must be a .obj, .ply, .stl, .gltf or .glb; include scenes by [[include]]");
    const int64_t material = table.has("material") ? int64_t(material_named_in(table)) : -1;
    const size_t first = scene_.instances.size();
    place(table, "file", mesh.file, part(table, "file", mesh.file, true, material), true);
    if (const uint32_t name = placed_name(table); name != NO_NAME)
        for (size_t i = first; i < scene_.instances.size(); ++i) scene_.instances[i].name = name;
}

void TomlScene::read_shape(const TableReader& table) {
    const auto type = table.require("type", table.choice<keys::ShapeType>("type"));
    table.allow(keys::keys_of_shape(type));
    if (type == keys::ShapeType::mesh) return add_mesh(table);
    const uint32_t material = material_named_in(table);
    switch (type) {
    case keys::ShapeType::sphere:
        return add_sphere(table, material);
    case keys::ShapeType::rectangle:
        return add_rectangle(table, material);
    case keys::ShapeType::box:
        return add_box(table, material);
    case keys::ShapeType::plane:
        return add_plane(table, material);
    case keys::ShapeType::disk:
        return add_disk(table, material);
    case keys::ShapeType::cylinder:
        return add_round(table, ShapeKind::cylinder, material);
    case keys::ShapeType::cone:
        return add_round(table, ShapeKind::cone, material);
    case keys::ShapeType::torus:
        return add_torus(table, material);
    case keys::ShapeType::ellipsoid:
        return add_ellipsoid(table, material);
    case keys::ShapeType::mesh:
        break;
    }
}

/// Of the chapter's measure and the radiometric one at least one is needed. One that is left out
/// follows from the other, and so would one that is black.
static void require_measure(const TableReader& table, std::string_view radiometric) {
    const auto measure = table.color(radiometric, NOT_NEGATIVE);
    const auto intensity = table.color("chapter_intensity", NOT_NEGATIVE);
    if (!measure && !intensity) table.fail(radiometric, "is missing; add it, or chapter_intensity");
    const glm::vec3 black(0.0f);
    if (measure && intensity && (*measure == black) != (*intensity == black))
        table.fail(*measure == black ? radiometric : "chapter_intensity",
                   "is black beside a light that is not; leave it out, or give a value above 0");
}

/// Reads a light without geometry, of which the chapter may say more.
template <class Light>
static void add_light(const TableReader& table, std::vector<Light>& lights,
                      std::map<uint32_t, glm::vec3>& intensities) {
    Light light;
    for_each_field(light, [&]<class Value>(const auto& field, Value& value) {
        if constexpr (std::is_same_v<Value, glm::vec3>) {
            if (field.rules.absent != FROM_CHAPTER) return;
            require_measure(table, field.key);
            value = Value(0.0f);
        }
    });
    read_fields(table, light);
    keys::ChapterLight stated;
    read_fields(table, stated);
    if (table.has("chapter_intensity")) intensities[uint32_t(lights.size())] = stated.intensity;
    lights.push_back(light);
}

const LightProfile& TomlScene::profile(const TableReader& table) {
    const std::string name = table.require("ies", table.text("ies"));
    const fs::path file = context_.resolve(folder_, name, table.where("ies"));
    if (!fs::exists(file)) table.fail("ies", fmt::format("names '{}', which does not exist", name));
    const auto [found, is_new] = profiles_.try_emplace(file);
    if (is_new) {
        Notes notes = context_.notes_of(file);
        found->second = load_ies_within(context_, file, notes);
        for (const std::string& sentence : notes.sentences()) scene_.notes.push_back(sentence);
    }
    return found->second;
}

void TomlScene::add_photometric_light(const TableReader& table) {
    std::vector<PhotometricLight>& lights = scene_.photometric_lights;
    add_light(table, lights, scene_.chapter.intensities.photometric_lights);
    PhotometricLight& light = lights.back();
    const glm::vec3 across = glm::cross(light.start, light.back);
    if (!(glm::length(across) > 1e-6f * glm::length(light.start)))
        table.fail("start", "must not be zero or along direction");
    light.profile = profile(table);
    context_.spend(5, bytes_of(light.profile), table.where());
}

/// A black material that emits the light's radiance.
uint32_t TomlScene::emitter(const TableReader& table) {
    require_measure(table, "radiance");
    const auto [found, is_new] =
        emitter_of_table_.try_emplace(table.where(), uint32_t(scene_.materials.size()));
    if (!is_new) return found->second;
    keys::Emission emission;
    keys::Faces faces;
    read_fields(table, emission);
    read_fields(table, faces);
    Material material;
    material.name = "light";
    material.base_color = glm::vec3(0.0f);
    material.emission = emission.radiance;
    material.two_sided = faces.two_sided;
    material.group = emission.group;
    scene_.materials.push_back(material);
    return found->second;
}

void TomlScene::add_area_light(const TableReader& table, AreaLight light, uint32_t material) {
    read_fields(table, light);
    light.material = material;
    light.two_sided = scene_.materials[material].two_sided;
    scene_.chapter.area_lights.push_back(light);
}

void TomlScene::add_rectangle_light(const TableReader& table) {
    const uint32_t material = emitter(table);
    add_rectangle(table, material);
    const Mesh& mesh = scene_.meshes[scene_.instances.back().mesh];
    const std::vector<glm::vec3>& corners = mesh.positions; // they go around
    add_area_light(table,
                   {.kind = AreaLightKind::rectangle,
                    .position = corners[0],
                    .edge1 = corners[1] - corners[0],
                    .edge2 = corners[3] - corners[0]},
                   material);
}

void TomlScene::add_disk_light(const TableReader& table) {
    const uint32_t material = emitter(table);
    add_disk(table, material);
    const glm::mat4& m = scene_.shapes.back().object_to_world;
    const bool mirrored = glm::determinant(glm::mat3(m)) < 0.0f; // the front stays the front
    add_area_light(table,
                   {.kind = AreaLightKind::disk,
                    .position = glm::vec3(m[3]),
                    .edge1 = glm::vec3(m[mirrored ? 0 : 2]),
                    .edge2 = glm::vec3(m[mirrored ? 2 : 0])},
                   material);
}

void TomlScene::add_sphere_light(const TableReader& table) {
    const uint32_t material = emitter(table);
    add_sphere(table, material);
    const Sphere& sphere = scene_.spheres.back();
    add_area_light(
        table, {.kind = AreaLightKind::sphere, .position = sphere.center, .radius = sphere.radius},
        material);
}

void TomlScene::read_light(const TableReader& table) {
    const auto type = table.require("type", table.choice<keys::LightType>("type"));
    table.allow(keys::keys_of_light(type));
    switch (type) {
    case keys::LightType::photometric:
        return add_photometric_light(table);
    case keys::LightType::rectangle:
        return add_rectangle_light(table);
    case keys::LightType::disk:
        return add_disk_light(table);
    case keys::LightType::sphere:
        return add_sphere_light(table);
    default:
        break;
    }
    visit_keys(type,
               [&]<class Own, class... More>(std::string_view, TypeTag<Own>, TypeTag<More>...) {
#define ONDE_ADD(Type, list, words)                                                                \
    if constexpr (std::is_same_v<Own, Type>)                                                       \
        add_light(table, scene_.list, scene_.chapter.intensities.list);
                   LIGHT_LISTS(ONDE_ADD)
#undef ONDE_ADD
               });
}

} // namespace onde
