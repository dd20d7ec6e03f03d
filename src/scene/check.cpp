#include "scene/check.h"

#include "core/error.h"
#include "scene/light_groups.h"
#include "scene/load.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace onde {

namespace {

bool finite(float x) {
    return std::isfinite(x);
}
bool finite(const glm::vec2& v) {
    return finite(v.x) && finite(v.y);
}
bool finite(const glm::vec3& v) {
    return finite(v.x) && finite(v.y) && finite(v.z);
}
bool finite(const glm::vec4& v) {
    return finite(v.x) && finite(v.y) && finite(v.z) && finite(v.w);
}
bool finite(const glm::mat4& m) {
    return std::all_of(&m[0][0], &m[0][0] + 16, [](float x) { return finite(x); });
}
bool is_unit(const glm::vec3& v) {
    return std::abs(glm::length(v) - 1.0f) < 1e-3f;
}

void require(bool holds, const char* list, size_t index, const std::string& name,
             std::string_view problem) {
    if (holds) return;
    const std::string label = name.empty() ? "" : " '" + name + "'";
    throw InputError("{} {}{}: {}", list, index, label, problem);
}

void check_texture(const Scene& scene, size_t i) {
    const Texture& texture = scene.textures[i];
    const int32_t same = texture.same_image_as;
    const bool earlier = same >= NO_TEXTURE && same < int64_t(i);
    require(earlier && (same == NO_TEXTURE || !scene.textures[size_t(same)].image.rgba.empty()),
            "texture", i, texture.name, "the texture whose image it has too is none before it");
    const UvTransform& t = texture.transform;
    require(finite(t.offset) && finite(t.scale) && finite(t.rotation), "texture", i, texture.name,
            "its transform is not finite");
    const ByteImage& image = image_of(scene.textures, texture);
    require(image.width > 0 && image.height > 0, "texture", i, texture.name, "it has no pixels");
    require(image.rgba.size() == size_t(4) * image.width * image.height, "texture", i, texture.name,
            "its size and its pixels disagree");
    require(image.low.empty() || image.low.size() == image.rgba.size(), "texture", i, texture.name,
            "not all of its samples have 16 bits");
}

bool in_range(const FieldRules& rules, float x) {
    if (rules.form == Form::degrees)
        return finite(x) && x >= glm::radians(float(rules.range.low)) &&
               x <= glm::radians(float(rules.range.high));
    return x >= float(rules.range.low) && x <= float(rules.range.high);
}

/// What is wrong with a member of the scene, to follow its name; or nothing.
std::string problem(const Scene&, const FieldRules& rules, float value) {
    return in_range(rules, value) ? "" : why_not_in(rules.range, value);
}

std::string problem(const Scene& scene, const FieldRules& rules, uint32_t value) {
    if (rules.form == Form::material && value >= scene.materials.size()) return "does not exist";
    if (rules.form == Form::name)
        return value == NO_NAME || value < scene.names.size() ? "" : "does not exist";
    if (rules.form == Form::grid)
        return value == NO_GRID || value < scene.grids.size() ? "" : "does not exist";
    return rules.range.contains(value) ? "" : why_not_in(rules.range, value);
}

std::string problem(const Scene& scene, const FieldRules&, int32_t texture) {
    const bool exists = texture >= NO_TEXTURE && texture < int64_t(scene.textures.size());
    return exists ? "" : "does not exist";
}

template <glm::length_t N>
std::string problem(const Scene& scene, const FieldRules& rules, const glm::vec<N, float>& v) {
    for (glm::length_t i = 0; i < N; ++i)
        if (const std::string text = problem(scene, rules, v[i]); !text.empty()) return text;
    if constexpr (N == 3)
        if (rules.form == Form::travel && !is_unit(v)) return "is not unit";
    return "";
}

std::string problem(const Scene&, const FieldRules&, const glm::mat4& m) {
    return finite(m) ? "" : "must be finite";
}

std::string problem(const Scene&, const FieldRules& rules, const std::string& text) {
    return rules.form == Form::group ? why_no_group(text) : "";
}

/// Any list of texts, switch and enum is right; maps are checked by themselves.
template <class T>
requires(std::is_enum_v<T> || std::is_same_v<T, bool> ||
         std::is_same_v<T, std::vector<std::string>> || std::is_same_v<T, Image>) std::string
    problem(const Scene&, const FieldRules&, const T&) {
    return "";
}

template <class T>
std::string problem(const Scene& scene, const FieldRules& rules, const std::optional<T>& value);

template <Fielded T>
std::string problem(const Scene& scene, const FieldRules&, const T& thing) {
    std::string first;
    for_each_field(thing, [&](const auto& field, const auto& value) {
        if (!first.empty()) return;
        first = problem(scene, field.rules, value);
        if (!first.empty()) first = fmt::format("{} {}", name_of(field), first);
    });
    return first;
}

template <class T>
std::string problem(const Scene& scene, const FieldRules& rules, const std::optional<T>& value) {
    return value ? problem(scene, rules, *value) : "";
}

/// Every member of a thing against its table.
template <Fielded T>
void check_fields(const Scene& scene, const T& thing, const char* list, size_t index,
                  const std::string& name = {}) {
    const std::string text = problem(scene, {}, thing);
    require(text.empty(), list, index, name, "its " + text);
}

template <class T>
bool all_finite(const std::vector<T>& values) {
    return std::all_of(values.begin(), values.end(), [](const T& value) { return finite(value); });
}

void check_mesh(const Scene& scene, size_t i) {
    const Mesh& mesh = scene.meshes[i];
    const size_t vertices = mesh.positions.size(), materials = scene.materials.size();
    const auto check = [&](bool holds, const char* problem) {
        require(holds, "mesh", i, mesh.name, problem);
    };
    const auto in_range = [&](const glm::uvec3& t) {
        return t.x < vertices && t.y < vertices && t.z < vertices;
    };
    check(all_finite(mesh.positions), "a position is not finite");
    check(mesh.normals.empty() || mesh.normals.size() == vertices, "normals are missing");
    check(std::all_of(mesh.normals.begin(), mesh.normals.end(), is_unit), "a normal is not unit");
    check(mesh.uvs.empty() || mesh.uvs.size() == vertices, "texture coordinates are missing");
    for (const std::vector<glm::vec2>& uvs : mesh.more_uvs) {
        check(uvs.empty() || uvs.size() == vertices, "texture coordinates are missing");
        check(all_finite(uvs), "a texture coordinate is not finite");
    }
    check(mesh.colors.empty() || mesh.colors.size() == vertices, "vertex colours are missing");
    check(all_finite(mesh.colors), "a vertex colour is not finite");
    check(mesh.tangents.empty() || mesh.tangents.size() == vertices, "tangents are missing");
    check(all_finite(mesh.tangents), "a tangent is not finite");
    check(all_finite(mesh.uvs), "a texture coordinate is not finite");
    check(std::all_of(mesh.triangles.begin(), mesh.triangles.end(), in_range),
          "a triangle names a vertex that does not exist");
    check(mesh.materials.size() == mesh.triangles.size(), "triangles and materials disagree");
    check(std::all_of(mesh.materials.begin(), mesh.materials.end(),
                      [&](uint32_t material) { return material < materials; }),
          "a triangle names a material that does not exist");
}

} // namespace

void check_transform(const glm::mat4& m, const char* list, size_t i) {
    require(finite(m), list, i, "", "its transform is not finite");
    require(m[0][3] == 0.0f && m[1][3] == 0.0f && m[2][3] == 0.0f && m[3][3] == 1.0f, list, i, "",
            "its transform is not affine");
    require(glm::determinant(m) != 0.0f && finite(glm::inverse(m)), list, i, "",
            "its transform is not invertible");
}

namespace {

void check_instance(const Scene& scene, size_t i) {
    const Instance& instance = scene.instances[i];
    require(instance.mesh < scene.meshes.size(), "instance", i, "",
            "it names a mesh that does not exist");
    check_fields(scene, instance, "instance", i);
    check_transform(instance.object_to_world, "instance", i);
}

void check_shape(const Scene& scene, size_t i) {
    const Shape& shape = scene.shapes[i];
    check_fields(scene, shape, "shape", i);
    require(shape.kind != ShapeKind::torus ||
                (shape.minor_radius > 0.0f && shape.minor_radius < 1.0f),
            "shape", i, "", "its minor radius must lie between 0 and the major one");
    check_transform(shape.object_to_world, "shape", i);
}

void check_lights(const Scene& scene) {
    for_each_light_list(scene, [&](const auto& lights, const auto&, const char* words) {
        for (size_t i = 0; i < lights.size(); ++i) check_fields(scene, lights[i], words, i);
    });
}

/// What the chapter states of elements of one of the scene's lists, by index.
template <class T>
void check_stated(const Scene& scene, const std::map<uint32_t, T>& stated, size_t count,
                  const char* list, const std::string& member = {}) {
    for (const auto& [index, value] : stated) {
        require(index < count, list, index, "", "the chapter names it, but it does not exist");
        const std::string text = problem(scene, {.range = NOT_NEGATIVE}, value);
        require(text.empty(), list, index, "", "its " + member + text);
    }
}

void check_chapter(const Scene& scene) {
    const ChapterScene& chapter = scene.chapter;
    check_stated(scene, chapter.phong, scene.materials.size(), "material");
    for_each_light_list(scene, [&](const auto& lights, const auto& intensities, const char* words) {
        check_stated(scene, intensities, lights.size(), words, "chapter_intensity ");
    });
    for (size_t i = 0; i < chapter.area_lights.size(); ++i)
        check_fields(scene, chapter.area_lights[i], "area light", i);
    const std::string text = problem(scene, {}, chapter.whitted);
    if (!text.empty()) throw InputError("whitted: its {}", text);
}

void check_environment(const Scene& scene) {
    const Environment& environment = scene.environment;
    const std::string text = problem(scene, {}, environment);
    if (!text.empty()) throw InputError("environment: its {}", text);
    if (!environment.map) return;
    const Image& map = *environment.map;
    if (map.width == 0 || map.height == 0 || map.channels != 3 ||
        map.pixels.size() != size_t(3) * map.width * map.height)
        throw InputError("environment: its map must have pixels of 3 channels");
    if (!std::all_of(map.pixels.begin(), map.pixels.end(),
                     [](float x) { return finite(x) && x >= 0.0f; }))
        throw InputError("environment: its map must be finite and not negative");
}

/// The sum of what glows and is never dimmed on the way has no end where the medium has none.
bool is_bounded(const Medium& medium) {
    if (medium.grid != NO_GRID) return true;
    for (glm::length_t c = 0; c < 3; ++c)
        if (medium.emission[c] > 0.0f && medium.absorption[c] + medium.scattering[c] == 0.0f)
            return false;
    return true;
}

void check_grid(const Scene& scene, size_t i) {
    const DensityGrid& grid = scene.grids[i];
    const auto check = [&](bool holds, const char* problem) {
        require(holds, "grid", i, grid.name, problem);
    };
    const uint64_t bricks = uint64_t(grid.table.x) * grid.table.y * grid.table.z;
    check(bricks > 0 && bricks == grid.bricks.size(), "its size and its bricks disagree");
    for (const DensityGrid::Brick& brick : grid.bricks) {
        check(brick.largest >= 0.0f && brick.largest <= LARGEST_DENSITY,
              "a density is negative or too large");
        check(brick.first == DensityGrid::EVEN ||
                  uint64_t(brick.first) + DensityGrid::BRICK_SAMPLES <= grid.samples.size(),
              "a brick has no samples");
    }
    const glm::vec3 end(grid.table * DensityGrid::CELLS);
    check(glm::all(glm::greaterThanEqual(grid.low, glm::vec3(0))) &&
              glm::all(glm::lessThan(grid.low, grid.high)) &&
              glm::all(glm::lessThanEqual(grid.high, end)),
          "its box is not within its samples");
}

void check_media(const Scene& scene) {
    for (size_t i = 0; i < scene.grids.size(); ++i) check_grid(scene, i);
    if (const std::string text = problem(scene, {}, scene.medium); !text.empty())
        throw InputError("medium: its {}", text);
    if (!is_bounded(scene.medium))
        throw InputError("medium: its emission has no end, as what is around everything; give it "
                         "absorption or scattering, or a density");
    for_each_medium(scene, [&](const Medium& medium) {
        if (medium.grid == NO_GRID) return;
        check_transform(medium.placement, "placement of the grid", medium.grid);
        check_transform(medium.placement * scene.grids[medium.grid].from_samples, "grid",
                        medium.grid);
    });
}

} // namespace

void check_material(const Scene& scene, size_t i) {
    const Material& m = scene.materials[i];
    check_fields(scene, m, "material", i, m.name);
    const bool mixed = m.kind == MaterialKind::metallic_roughness && m.transmission > 0.0f;
    require(!m.medium || mixed || m.kind == MaterialKind::dielectric, "material", i, m.name,
            "its medium needs a clear kind: dielectric, or metallic-roughness with transmission");
}

void check_camera(const Camera& camera, size_t i) {
    check_fields(Scene{}, camera, "camera", i, camera.name);
    require(camera.aperture_blades == 0 || camera.aperture_blades >= 3, "camera", i, camera.name,
            "its aperture needs at least 3 blades, or 0 to be round");
    const glm::mat3 axes(camera.camera_to_world);
    require(is_unit(axes[0]) && is_unit(axes[1]) && is_unit(axes[2]) &&
                std::abs(glm::determinant(axes) - 1.0f) < 1e-2f,
            "camera", i, camera.name, "its transform must be a rotation and a translation");
}

namespace {

/// With the notes, which tell what was left out.
[[noreturn]] void throw_empty(const Scene& scene) {
    if (scene.notes.empty()) throw InputError("the scene is empty; add a shape or a mesh");
    throw InputError("the scene is empty; add a shape or a mesh, or see to what was noted: {}",
                     fmt::join(scene.notes, " "));
}

bool has_geometry(const Scene& scene) {
    return !scene.spheres.empty() || !scene.shapes.empty() ||
           std::any_of(scene.instances.begin(), scene.instances.end(),
                       [&](const Instance& instance) {
                           return !scene.meshes[instance.mesh].triangles.empty();
                       });
}

} // namespace

void check_scene(const Scene& scene) {
    for (size_t i = 0; i < scene.textures.size(); ++i) check_texture(scene, i);
    for (size_t i = 0; i < scene.materials.size(); ++i) check_material(scene, i);
    for (size_t i = 0; i < scene.meshes.size(); ++i) check_mesh(scene, i);
    for (size_t i = 0; i < scene.instances.size(); ++i) check_instance(scene, i);
    for (size_t i = 0; i < scene.spheres.size(); ++i)
        check_fields(scene, scene.spheres[i], "sphere", i);
    for (size_t i = 0; i < scene.shapes.size(); ++i) check_shape(scene, i);
    check_lights(scene);
    check_environment(scene);
    check_media(scene);
    light_groups(scene); // not too many
    for (size_t i = 0; i < scene.cameras.size(); ++i) check_camera(scene.cameras[i], i);
    const std::string text = problem(scene, {}, scene.settings);
    if (!text.empty()) throw InputError("render settings: their {}", text);
    check_chapter(scene);
    if (!has_geometry(scene)) throw_empty(scene);
}

} // namespace onde
