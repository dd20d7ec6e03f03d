// Other files in Onde's scene format: how they are loaded once and placed, as shapes and includes.
#include "core/error.h"
#include "core/shown.h"
#include "scene/angle.h"
#include "scene/loaders.h"
#include "scene/toml/fields.h"
#include "scene/toml/keys.h"
#include "scene/toml/scene.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde {
namespace fs = std::filesystem;
namespace keys = toml_keys;

/// What a table says of a place, in double precision; rotation in degrees.
struct ExactPlace {
    glm::dvec3 position, rotation, scale;
};

static ExactPlace exact_place(const TableReader& table) {
    return {table.point("position").value_or(glm::dvec3(0.0) - table.origin()),
            table.exact_vector("rotation").value_or(glm::dvec3(0.0)),
            table.exact_vector("scale").value_or(glm::dvec3(1.0))};
}

/// The placement in double precision, of things that are counted from a point far out.
static glm::mat4 exact_placement(const ExactPlace& place, const glm::dvec3& from) {
    const glm::dvec3 turn = radians_of(place.rotation);
    glm::dmat4 m(1.0);
    m = glm::rotate(m, turn.z, glm::dvec3(0, 0, 1));
    m = glm::rotate(m, turn.y, glm::dvec3(0, 1, 0));
    m = glm::rotate(m, turn.x, glm::dvec3(1, 0, 0));
    m = glm::scale(m, place.scale);
    m[3] = glm::dvec4(place.position + glm::dmat3(m) * from, 1.0);
    return glm::mat4(m);
}

std::optional<Motion> TomlScene::motion_of(const TableReader& table,
                                           std::initializer_list<std::string_view> keys) {
    if (!table.has("motion")) return std::nullopt;
    context_.found_animation();
    scene_.moment = context_.options().at.value_or(0.0);
    return Motion(table.tables("motion"), keys, *scene_.moment);
}

glm::mat4 TomlScene::placement(const TableReader& table, const glm::dvec3& from) {
    keys::Placement p{.position = glm::vec3(glm::dvec3(0.0) - table.origin())};
    read_fields(table, p);
    if (!std::isnormal(p.scale.x * p.scale.y * p.scale.z))
        table.fail("scale", "must not be 0 along any axis, nor extreme");
    if (const auto motion = motion_of(table, {"position", "rotation", "scale"})) {
        const ExactPlace still = exact_place(table);
        return exact_placement({motion->point("position", still.position),
                                motion->vector("rotation", still.rotation),
                                motion->vector("scale", still.scale)},
                               from);
    }
    if (from != glm::dvec3(0.0)) return exact_placement(exact_place(table), from);
    glm::mat4 m = glm::translate(glm::mat4(1.0f), p.position);
    m = glm::rotate(m, p.rotation.z, glm::vec3(0, 0, 1));
    m = glm::rotate(m, p.rotation.y, glm::vec3(0, 1, 0));
    m = glm::rotate(m, p.rotation.x, glm::vec3(1, 0, 0));
    return glm::scale(m, p.scale);
}

static void keep_geometry(Scene& scene) {
    for_each_light_list(scene, [](auto& lights, const auto&, const char*) { lights.clear(); });
    scene.cameras.clear();
    scene.environment = {};
    scene.medium = {};
    scene.settings = {};
    ChapterScene materials;
    materials.phong = std::move(scene.chapter.phong);
    scene.chapter = std::move(materials);
}

/// All that stands in a file came with it, named or not.
static void name_asset(Scene& scene, const std::string& asset) {
    for (PlacedName& name : scene.names) name.asset = asset;
    const auto unnamed = uint32_t(scene.names.size());
    scene.names.push_back({"", asset});
    const auto name_each = [&](auto& things) {
        for (auto& thing : things)
            if (thing.name == NO_NAME) thing.name = unnamed;
    };
    name_each(scene.instances);
    name_each(scene.spheres);
    name_each(scene.shapes);
}

TomlScene::Part& TomlScene::part(const TableReader& table, std::string_view key,
                                 const std::string& file, bool geometry_only, int64_t material) {
    const fs::path path = context_.resolve(folder_, file, table.where(key));
    if (!fs::exists(path))
        table.fail(key, fmt::format("names '{}', which does not exist; check the name", file));
    const auto [found, is_new] =
        parts_.try_emplace(fmt::format("{} {} {}", geometry_only, material, path.string()));
    Part& part = found->second;
    if (!is_new) return part;
    part.placed = load_part(path, context_, ancestors_);
    if (geometry_only) keep_geometry(part.placed);
    for (const std::string& note : part.placed.notes) scene_.notes.push_back(file + ": " + note);
    name_asset(part.placed, path.stem().string());
    part.offsets = append_assets(scene_, part.placed);
    if (material >= 0)
        for (size_t i = part.offsets.meshes; i < scene_.meshes.size(); ++i)
            std::fill(scene_.meshes[i].materials.begin(), scene_.meshes[i].materials.end(),
                      uint32_t(material));
    return part;
}

void TomlScene::place(const TableReader& table, std::string_view key, const std::string& file,
                      const Part& part, bool is_placed) {
    const glm::dvec3& from = part.placed.origin;
    const glm::mat4 transform =
        is_placed ? placement(table, from)
                  : glm::translate(glm::mat4(1.0f), glm::vec3(from - table.origin()));
    context_.spend(1, placed_bytes(part.placed), table.where(key));
    try {
        append_placed(scene_, part.placed, part.offsets, transform);
    } catch (const InputError& error) {
        throw InputError("{}: '{}': {}", table.where(key), shown(file), error.what());
    }
}

void TomlScene::read_includes(const TableReader& root) {
    if (!root.has("include")) return;
    if (root.is_array_of_texts("include")) {
        for (const std::string& file : root.texts("include"))
            place(root, "include", file, part(root, "include", file, false, -1), false);
        return;
    }
    for (const TableReader& table : root.tables("include")) {
        table.allow(keys_of<keys::Include, keys::Placement>());
        keys::Include include;
        read_fields(table, include);
        const std::string& file = include.file;
        place(table, "file", file, part(table, "file", file, false, -1), true);
    }
}

} // namespace onde
