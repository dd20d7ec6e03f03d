// Onde's own scene format; docs/scene-format.md is its reference.
#include "core/error.h"
#include "core/files.h"
#include "scene/load.h"
#include "scene/loaders.h"
#include "scene/phong.h"
#include "scene/toml_lesson.h"
#include "scene/toml_scene.h"

#include <algorithm>

namespace onde {
namespace fs = std::filesystem;

static constexpr uint64_t MAX_BYTES = uint64_t(256) << 20;
static constexpr size_t MAX_DEPTH = 16;

static toml::table parse(const fs::path& path) {
    const std::string text = read_file(path, MAX_BYTES);
    try {
        return toml::parse(text, path.string());
    } catch (const toml::parse_error& error) {
        throw InputError("{}:{}:{}: not valid TOML: {}", path.string(),
                         uint32_t(error.source().begin.line), uint32_t(error.source().begin.column),
                         error.description());
    }
}

TomlScene::TomlScene(const fs::path& path, std::vector<fs::path> ancestors)
    : folder_(path.parent_path()), ancestors_(std::move(ancestors)) {
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
                "include", "lesson"});
    read_settings(root);
    for (const TableReader& lesson : root.tables("lesson")) scene_.lesson = read_lesson(lesson);
    read_whitted(root);
    for (const TableReader& camera : root.tables("camera")) read_camera(camera);
    for (const TableReader& material : root.tables("material")) read_material(material);
    for (const TableReader& shape : root.tables("shape")) read_shape(shape);
    for (const TableReader& light : root.tables("light")) read_light(light);
    read_environment(root);
    read_includes(root);
    return std::move(scene_);
}

void TomlScene::read_settings(const TableReader& root) {
    RenderSettings& settings = scene_.settings;
    for (const TableReader& film : root.tables("film")) {
        film.allow({"size"});
        if (!film.has("size")) continue;
        const auto size = *film.numbers("size", 2, {.low = 1, .high = 65535});
        if (size[0] != float(uint32_t(size[0])) || size[1] != float(uint32_t(size[1])))
            film.fail("size", "must be two whole numbers");
        settings.width = uint32_t(size[0]);
        settings.height = uint32_t(size[1]);
    }
    for (const TableReader& render : root.tables("render")) {
        render.allow({"samples", "depth", "seed", "filter", "exposure", "integrator"});
        settings.samples = render.integer("samples", 1, 1u << 24);
        settings.depth = render.integer("depth", 1, 1u << 16);
        settings.seed = render.integer("seed", 0, 0xffffffffu);
        settings.exposure = render.number("exposure", {.low = -64, .high = 64});
        settings.filter = render.choice<Filter>("filter");
        settings.integrator = render.choice<IntegratorKind>("integrator");
    }
}

/// Whose factor light gets that is reflected (C8).
enum class Reflectivity { surface, source };

constexpr auto enum_words(Reflectivity) {
    return std::array{EnumWord{Reflectivity::surface, "surface"},
                      EnumWord{Reflectivity::source, "source"}};
}

void TomlScene::read_whitted(const TableReader& root) {
    for (const TableReader& table : root.tables("whitted")) {
        table.allow({"ambient", "background", "saturate", "reflectivity", "distance_falloff",
                     "fresnel", "epsilon", "wavelengths"});
        WhittedSettings& w = scene_.whitted;
        w.given = true;
        w.ambient = table.color("ambient", NOT_NEGATIVE);
        w.background = table.color("background", NOT_NEGATIVE);
        w.saturate = table.boolean("saturate").value_or(true);
        w.source_reflectivity = table.choice<Reflectivity>("reflectivity") == Reflectivity::source;
        w.distance_falloff = table.boolean("distance_falloff").value_or(false);
        w.fresnel = table.boolean("fresnel").value_or(false);
        w.epsilon = table.number("epsilon", UNIT).value_or(0.0f);
        w.wavelengths = table.integer("wavelengths", 3, 16).value_or(7);
    }
}

/// The chapter's screen (C3).
static std::optional<ScreenWindow> read_screen(const TableReader& camera) {
    for (const TableReader& table : camera.tables("screen")) {
        table.allow({"size", "distance", "first_pixel"});
        const auto pair = [&](std::string_view key, Range range) -> std::optional<glm::vec2> {
            const auto numbers = table.numbers(key, 2, range);
            if (!numbers) return std::nullopt;
            return glm::vec2((*numbers)[0], (*numbers)[1]);
        };
        return ScreenWindow{table.require("size", pair("size", POSITIVE)),
                            table.require("distance", table.number("distance", POSITIVE)),
                            pair("first_pixel", ANY_NUMBER)};
    }
    return std::nullopt;
}

void TomlScene::read_camera(const TableReader& table) {
    table.allow({"name", "position", "look_at", "up", "vertical_fov", "aperture", "focus_distance",
                 "orthographic_height", "screen"});
    const glm::vec3 position = table.require("position", table.vector("position"));
    const glm::vec3 target = table.require("look_at", table.vector("look_at"));
    const glm::vec3 up = table.vector("up").value_or(glm::vec3(0, 1, 0));
    const glm::dvec3 back = glm::dvec3(position) - glm::dvec3(target);
    const double distance = glm::length(back);
    if (distance < 1e-20) table.fail("look_at", "must differ from position");
    const glm::dvec3 right = glm::cross(glm::dvec3(up), back / distance);
    if (glm::length(right) < 1e-6 * glm::length(glm::dvec3(up)) || up == glm::vec3(0.0f))
        table.fail("up", "must not be zero or parallel to the view from position to look_at");
    const glm::vec3 x(glm::normalize(right)), z(back / distance), y = glm::cross(z, x);
    Camera camera;
    camera.name = table.text("name").value_or("");
    camera.camera_to_world = glm::mat4(glm::vec4(x, 0.0f), glm::vec4(y, 0.0f), glm::vec4(z, 0.0f),
                                       glm::vec4(position, 1.0f));
    const Range fov{.low = 0.01, .high = 179.9};
    camera.vertical_fov = glm::radians(table.number("vertical_fov", fov).value_or(40.0f));
    camera.aperture_radius = table.number("aperture", NOT_NEGATIVE).value_or(0.0f);
    camera.focus_distance = table.number("focus_distance", POSITIVE).value_or(float(distance));
    camera.orthographic_height = table.number("orthographic_height", POSITIVE).value_or(0.0f);
    camera.screen = read_screen(table);
    for (const char* key : {"vertical_fov", "orthographic_height"})
        if (camera.screen && table.has(key)) table.fail(key, "can't go with screen; give one");
    scene_.cameras.push_back(camera);
}

glm::vec3 TomlScene::base_color(const TableReader& table) const {
    if (table.has("color") && table.has("base_color"))
        table.fail("color", "is another name of base_color; give one of them");
    const char* key = table.has("color") ? "color" : "base_color";
    return table.color(key, UNIT).value_or(glm::vec3(0.8f));
}

int32_t TomlScene::texture(const TableReader& table, std::string_view key, bool srgb) {
    const auto name = table.text(key);
    if (!name) return NO_TEXTURE;
    const Wrap wrap = table.choice<Wrap>("wrap").value_or(Wrap::repeat);
    return add_texture_file(scene_, folder_, *name, {srgb, wrap, wrap}, table.where(key));
}

/// What Whitted needs of the material: its kind's meaning, and over it the keys that are given.
static Phong phong(const TableReader& table, const Material& material) {
    Phong p = phong_of(material);
    p.ambient = table.number("ambient", NOT_NEGATIVE).value_or(p.ambient);
    p.diffuse = table.number("diffuse", NOT_NEGATIVE).value_or(p.diffuse);
    p.specular = table.number("specular", NOT_NEGATIVE).value_or(p.specular);
    p.exponent = table.number("exponent", NOT_NEGATIVE).value_or(p.exponent);
    p.reflection = table.number("reflection", UNIT).value_or(p.reflection);
    p.transmission = table.number("transmission", UNIT).value_or(p.transmission);
    p.abbe = table.number("abbe", POSITIVE).value_or(p.abbe);
    return p;
}

void TomlScene::read_material(const TableReader& table) {
    table.allow({"name",
                 "kind",
                 "base_color",
                 "color",
                 "roughness",
                 "metallic",
                 "ior",
                 "emission",
                 "two_sided",
                 "base_color_texture",
                 "metallic_roughness_texture",
                 "emission_texture",
                 "normal_texture",
                 "normal_scale",
                 "wrap",
                 "ambient",
                 "diffuse",
                 "specular",
                 "exponent",
                 "reflection",
                 "transmission",
                 "abbe"});
    Material m;
    m.name = table.require("name", table.text("name"));
    m.kind = table.choice<MaterialKind>("kind").value_or(m.kind);
    const bool smooth = m.kind == MaterialKind::conductor || m.kind == MaterialKind::dielectric;
    m.base_color = base_color(table);
    m.roughness = table.number("roughness", UNIT).value_or(smooth ? 0.0f : 1.0f);
    m.metallic = table.number("metallic", UNIT).value_or(0.0f);
    m.ior = table.number("ior", {.low = 0.01, .high = 100}).value_or(1.5f);
    m.emission = table.color("emission", NOT_NEGATIVE).value_or(glm::vec3(0.0f));
    m.two_sided = table.boolean("two_sided").value_or(true);
    m.base_color_texture = texture(table, "base_color_texture", true);
    m.metallic_roughness_texture = texture(table, "metallic_roughness_texture", false);
    m.emission_texture = texture(table, "emission_texture", true);
    m.normal_texture = texture(table, "normal_texture", false);
    m.normal_scale = table.number("normal_scale").value_or(1.0f);
    m.phong = phong(table, m);
    if (!material_of_name_.try_emplace(m.name, uint32_t(scene_.materials.size())).second)
        table.fail("name", fmt::format("'{}' is taken by an earlier material", m.name));
    scene_.materials.push_back(std::move(m));
}

void TomlScene::read_environment(const TableReader& root) {
    for (const TableReader& table : root.tables("environment")) {
        table.allow({"radiance", "map", "rotation"});
        const glm::vec3 radiance = table.color("radiance", NOT_NEGATIVE).value_or(glm::vec3(1.0f));
        const float rotation = table.number("rotation").value_or(0.0f);
        if (const auto map = table.text("map")) {
            const fs::path file = resolve_inside(folder_, *map, table.where("map"));
            if (!fs::exists(file))
                table.fail("map", fmt::format("names '{}', which does not exist", *map));
            scene_.environment = load_environment(file, radiance, rotation);
        } else {
            scene_.environment.radiance = radiance;
            scene_.environment.rotation = glm::radians(rotation);
        }
    }
}

Scene load_toml(const fs::path& path, const std::vector<fs::path>& ancestors) {
    TomlScene scene(path, ancestors);
    const toml::table table = parse(path);
    return scene.read(TableReader(table, path.string(), ""));
}

} // namespace onde
