// Onde's own scene format; docs/scene-format.md is its reference.
#include "core/error.h"
#include "core/files.h"
#include "core/shown.h"
#include "scene/load.h"
#include "scene/loaders.h"
#include "scene/origin.h"
#include "scene/phong.h"
#include "scene/toml/depth.h"
#include "scene/toml/fields.h"
#include "scene/toml/keys.h"
#include "scene/toml/lesson.h"
#include "scene/toml/scene.h"

#include <algorithm>

namespace onde {
namespace fs = std::filesystem;

static constexpr uint64_t MAX_BYTES = uint64_t(256) << 20;
static constexpr size_t MAX_DEPTH = 16;   ///< of includes
static constexpr size_t MAX_NESTING = 32; ///< of keys and of brackets; toml++ recurses into both

static toml::table parse(const fs::path& path) {
    const std::string text = read_file(path, MAX_BYTES);
    if (const auto line = line_nested_deeper(text, MAX_NESTING))
        throw InputError(
            "{}:{}: nested too deep; keys have at most {} parts, and brackets stand at "
            "most {} deep",
            path.string(), *line, MAX_NESTING, MAX_NESTING);
    try {
        return toml::parse(text, path.string());
    } catch (const toml::parse_error& error) {
        throw InputError("{}:{}:{}: not valid TOML: {}", path.string(),
                         uint32_t(error.source().begin.line), uint32_t(error.source().begin.column),
                         shown(error.description(), 300));
    }
}

TomlScene::TomlScene(const fs::path& path, LoadContext& context, std::vector<fs::path> ancestors)
    : context_(context), folder_(path.parent_path()), ancestors_(std::move(ancestors)) {
    const fs::path self = fs::weakly_canonical(path);
    if (std::ranges::find(ancestors_, self) != ancestors_.end())
        throw InputError("{}: includes itself, directly or through another file; break the cycle",
                         path.string());
    if (ancestors_.size() >= MAX_DEPTH)
        throw InputError("{}: scenes are included more than {} deep; flatten them", path.string(),
                         MAX_DEPTH);
    ancestors_.push_back(self);
}

Scene TomlScene::read(const TableReader& root) {
    root.allow({"camera", "film", "render", "whitted", "material", "shape", "light", "environment",
                "medium", "include", "lesson"});
    read_settings(root);
    for (const TableReader& medium : root.tables("medium")) {
        scene_.medium = read_only<Medium>(medium);
        has_own_medium_ = true;
    }
    for (const TableReader& lesson : root.tables("lesson"))
        scene_.chapter.lesson = read_lesson(lesson);
    for (const TableReader& material : root.tables("material")) read_material(material);
    read_blends(root);
    read_places(root);
    scene_.origin = origin_of(extent_of(scene_));
    if (scene_.origin != glm::dvec3(0.0)) {
        forget_places();
        read_places(root.about(scene_.origin));
    }
    if (!context_.options().only_shapes) {
        read_textures(root);
        read_grids(root.about(scene_.origin));
    }
    return std::move(scene_);
}

void TomlScene::read_places(const TableReader& root) {
    for (const TableReader& camera : root.tables("camera")) read_camera(camera);
    for (const TableReader& shape : root.tables("shape")) read_shape(shape);
    for (const TableReader& light : root.tables("light")) read_light(light);
    read_environment(root);
    read_includes(root);
}

void TomlScene::forget_places() {
    scene_.instances.clear();
    scene_.spheres.clear();
    scene_.shapes.clear();
    for_each_light_list(scene_, [](auto& lights, auto& intensities, const char*) {
        lights.clear();
        intensities.clear();
    });
    scene_.chapter.area_lights.clear();
    scene_.cameras.clear();
    if (!has_own_environment_) scene_.environment = {};
    if (!has_own_medium_) scene_.medium = {};
}

void TomlScene::read_settings(const TableReader& root) {
    RenderSettings& settings = scene_.settings;
    for (const TableReader& table : root.tables("film")) {
        const auto film = read_only<toml_keys::Film>(table);
        if (!film.size) continue;
        settings.width = film.size->x;
        settings.height = film.size->y;
    }
    for (const TableReader& table : root.tables("render")) {
        table.allow(keys_of<RenderSettings>());
        read_fields(table, settings);
    }
    for (const TableReader& table : root.tables("whitted")) {
        scene_.chapter.whitted = read_only<WhittedSettings>(table);
        scene_.chapter.states_whitted = true;
    }
}

/// From the target to the position, as floats hold them where they can tell the two apart.
static glm::dvec3 back_of(const glm::dvec3& position, const glm::dvec3& target) {
    const glm::dvec3 back = glm::dvec3(rounded(position)) - glm::dvec3(rounded(target));
    return glm::length(back) > 0.0 ? back : position - target;
}

/// Where a camera is, and what it looks at.
struct View {
    glm::dvec3 position, target;
    glm::vec3 up;
};

/// Rotation and translation of a camera at `position` that looks at a target, `back` from it.
static glm::mat4 camera_to_world(const TableReader& table, const glm::vec3& position,
                                 const glm::dvec3& back, const glm::vec3& up) {
    const double distance = glm::length(back);
    if (distance < 1e-20) table.fail("look_at", "must differ from position");
    const glm::dvec3 right = glm::cross(glm::dvec3(up), back / distance);
    if (glm::length(right) < 1e-6 * glm::length(glm::dvec3(up)) || up == glm::vec3(0.0f))
        table.fail("up", "must not be zero or parallel to the view from position to look_at");
    const glm::vec3 x(glm::normalize(right)), z(back / distance), y = glm::cross(z, x);
    return glm::mat4(glm::vec4(x, 0.0f), glm::vec4(y, 0.0f), glm::vec4(z, 0.0f),
                     glm::vec4(position, 1.0f));
}

void TomlScene::read_camera(const TableReader& table) {
    table.allow(keys_of<Camera>());
    View view{table.require("position", table.point("position")),
              table.require("look_at", table.point("look_at")),
              table.vector("up").value_or(glm::vec3(0, 1, 0))};
    if (const auto motion = motion_of(table, {"position", "look_at", "up"})) {
        view.position = motion->point("position", view.position);
        view.target = motion->point("look_at", view.target);
        view.up = glm::vec3(motion->vector("up", glm::dvec3(view.up)));
    }
    const glm::dvec3 back = back_of(view.position, view.target);
    Camera camera;
    camera.camera_to_world = camera_to_world(table, glm::vec3(view.position), back, view.up);
    camera.vertical_fov = glm::radians(40.0f);
    camera.focus_distance = float(glm::length(back));
    read_fields(table, camera);
    for (const char* key : {"vertical_fov", "orthographic_height"})
        if (camera.screen && table.has(key)) table.fail(key, "can't go with screen; give one");
    for (const char* key : {"vertical_fov", "orthographic_height", "screen"})
        if (is_wide(camera) && table.has(key))
            table.fail(key,
                       fmt::format("can't go with a {}; leave it out", word_of(camera.projection)));
    if (camera.projection != Projection::fisheye && table.has("fisheye_angle"))
        table.fail("fisheye_angle", "is of fisheyes; give projection = \"fisheye\" too");
    scene_.cameras.push_back(camera);
}

/// By material, whether something in the scene has it.
static std::vector<bool> shown_materials(const Scene& scene) {
    std::vector<bool> shown(scene.materials.size(), false);
    std::vector<bool> placed(scene.meshes.size(), false);
    for (const Instance& instance : scene.instances) placed[instance.mesh] = true;
    for (size_t i = 0; i < placed.size(); ++i)
        for (size_t t = 0; placed[i] && t < scene.meshes[i].materials.size(); ++t)
            shown[scene.meshes[i].materials[t]] = true;
    for (const Sphere& sphere : scene.spheres) shown[sphere.material] = true;
    for (const Shape& shape : scene.shapes) shown[shape.material] = true;
    for (const AreaLight& light : scene.chapter.area_lights) shown[light.material] = true;
    const std::vector<bool> placed_ones = shown;
    for (size_t i = 0; i < placed_ones.size(); ++i)
        if (const auto other = scene.materials[i].blend_with; other && placed_ones[i])
            shown[*other] = true;
    return shown;
}

/// A key that materials and the chapter's both have is the chapter's alone in its own kind.
static std::vector<std::string_view> keys_of_others(MaterialKind kind) {
    if (kind != MaterialKind::phong) return {};
    return keys_of<Phong>();
}

void TomlScene::read_textures(const TableReader& root) {
    const std::vector<bool> shown = shown_materials(scene_);
    size_t i = 0;
    for (const TableReader& table : root.tables("material")) {
        if (shown[i])
            read_fields(
                table, scene_.materials[i],
                [&](std::string_view key, bool srgb) { return texture(table, key, srgb); },
                keys_of_others(scene_.materials[i].kind));
        ++i;
    }
}

void TomlScene::check_texture(const TableReader& table, std::string_view key) {
    const bool is_table = table.is_table(key);
    const TableReader of_file = is_table ? table.tables(key).front() : table;
    const std::string name = is_table ? read_only<toml_keys::TextureFile>(of_file).file
                                      : table.require(key, table.text(key));
    const std::string where = is_table ? of_file.where("file") : table.where(key);
    check_texture_file(context_, folder_, name, where);
}

int32_t TomlScene::texture(const TableReader& table, std::string_view key, bool srgb) {
    const Wrap wrap = table.choice<Wrap>("wrap").value_or(Wrap::repeat);
    if (!table.is_table(key)) {
        const std::string name = table.require(key, table.text(key));
        return add_texture_file(scene_, context_, folder_, name, {srgb, wrap, wrap},
                                table.where(key));
    }
    const TableReader inner = table.tables(key).front();
    const auto read = read_only<toml_keys::TextureFile>(inner);
    const Wrap own = read.wrap.value_or(wrap);
    const TextureUse use{.srgb = srgb,
                         .wrap_u = own,
                         .wrap_v = own,
                         .filter = read.filter,
                         .uv_set = read.uv_set,
                         .transform = {read.offset, read.rotation, read.scale}};
    return add_texture_file(scene_, context_, folder_, read.file, use, inner.where("file"));
}

/// What the table says to Whitted, over what its kind means to it; nothing if it says nothing.
static std::optional<Phong> read_phong(const TableReader& table, const Material& material) {
    const auto stated = [&](std::string_view key) { return table.has(key); };
    if (std::ranges::none_of(keys_of<Phong>(), stated)) return std::nullopt;
    Phong phong = phong_of(material);
    read_fields(table, phong);
    return phong;
}

void TomlScene::read_material(const TableReader& table) {
    table.allow(keys_of<Material, Phong>());
    Material m;
    const MaterialKind kind = table.choice<MaterialKind>("kind").value_or(m.kind);
    if (kind == MaterialKind::conductor || kind == MaterialKind::dielectric) m.roughness = 0.0f;
    const auto texture = [&](std::string_view key, bool) {
        check_texture(table, key);
        return NO_TEXTURE;
    };
    read_fields(table, m, texture, keys_of_others(kind));
    const uint32_t index = uint32_t(scene_.materials.size());
    if (const auto phong = read_phong(table, m)) scene_.chapter.phong[index] = *phong;
    if (!material_of_name_.try_emplace(m.name, index).second)
        table.fail("name", fmt::format("'{}' is taken by an earlier material", m.name));
    scene_.materials.push_back(std::move(m));
}

void TomlScene::read_blends(const TableReader& root) {
    size_t i = 0;
    for (const TableReader& table : root.tables("material")) {
        Material& material = scene_.materials[i++];
        const auto name = table.text("blend_with");
        if (!name) continue;
        const auto found = material_of_name_.find(*name);
        if (found == material_of_name_.end())
            table.fail("blend_with", fmt::format("names '{}', which no material is called", *name));
        if (found->second + 1 == i) table.fail("blend_with", "must name another material");
        material.blend_with = found->second;
    }
}

void TomlScene::read_environment(const TableReader& root) {
    for (const TableReader& table : root.tables("environment")) {
        table.allow(keys_of<Environment>());
        Environment& environment = scene_.environment;
        environment.radiance = glm::vec3(1.0f);
        read_fields(table, environment);
        if (environment.sky && table.has("map")) table.fail("map", "can't go with sky; give one");
        const auto map = table.text("map");
        if (!map || environment.map || context_.options().only_shapes) continue;
        const fs::path file = context_.resolve(folder_, *map, table.where("map"));
        if (!fs::exists(file))
            table.fail("map", fmt::format("names '{}', which does not exist", *map));
        environment.map = load_environment_within(context_, file, 0.0f).map;
    }
    has_own_environment_ = emits(scene_.environment);
}

Scene load_toml(const fs::path& path, LoadContext& context,
                const std::vector<fs::path>& ancestors) {
    TomlScene scene(path, context, ancestors);
    const toml::table table = parse(path);
    return scene.read(TableReader(table, path.string(), ""));
}

} // namespace onde
