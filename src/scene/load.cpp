#include "scene/load.h"

#include "core/error.h"
#include "core/files.h"
#include "core/shown.h"
#include "scene/daylight.h"
#include "scene/loaders.h"
#include "scene/origin.h"
#include "scene/scale.h"
#include "scene/texture_budget.h"

#include <fmt/format.h>

#include <algorithm>

namespace onde {
namespace fs = std::filesystem;

namespace {

/// A format by its extension. Scenes of our own know who includes them.
struct Format {
    std::string_view extension;
    Scene (*load)(const fs::path&, LoadContext&);
    bool is_model;
};
constexpr Format FORMATS[] = {{".gltf", load_gltf, true},   {".glb", load_gltf, true},
                              {".obj", load_obj, true},     {".ply", load_ply, true},
                              {".stl", load_stl, true},     {".pbrt", load_pbrt, false},
                              {".xml", load_mitsuba, false}};
constexpr std::string_view OWN = ".toml";

} // namespace

Scene load_part(const fs::path& path, LoadContext& context,
                const std::vector<fs::path>& ancestors) {
    if (path.empty()) throw InputError("the name of the scene is empty; give a {}", SCENE_FILES);
    std::error_code ignored;
    if (fs::is_directory(path, ignored))
        throw InputError("{}: is a folder; give the name of a scene in it", path.string());
    const std::string extension = lower_extension(path);
    if (extension == OWN) return load_toml(path, context, ancestors);
    const auto format = std::ranges::find(FORMATS, extension, &Format::extension);
    if (format == std::end(FORMATS))
        throw InputError("{}: '{}' is not a scene format of ours; give a {}", path.string(),
                         shown(extension), SCENE_FILES);
    return format->load(path, context);
}

bool is_model(const fs::path& path) {
    const auto format = std::ranges::find(FORMATS, lower_extension(path), &Format::extension);
    return format != std::end(FORMATS) && format->is_model;
}

/// Runs `work`; what it throws is said to be of that file.
template <class Work>
static auto naming(const fs::path& path, const Work& work) try {
    return work();
} catch (const InputError& error) {
    throw InputError("{}: {}", path.string(), error.what());
}

/// Says where the scene's 0 lies in the file.
static void note_origin(Scene& scene) {
    const glm::dvec3& o = scene.origin;
    if (o == glm::dvec3(0.0)) return;
    scene.notes.push_back(fmt::format(
        "The scene lies far from 0 for the digits of floats: it was moved by ({}, {}, {}), which "
        "leaves its picture as it is; its coordinates are reported as they are after that.",
        -o.x + 0.0, -o.y + 0.0, -o.z + 0.0));
}

/// Says so where the scene is too large for its details.
static void note_torn(Scene& scene) {
    constexpr double LEAST = 0.01; // of the details: a needle or two are in many files
    const Detail torn = torn_detail(details_of(scene));
    if (!(torn.weight > LEAST)) return;
    const glm::dvec3 at = torn.middle + scene.origin;
    scene.notes.push_back(fmt::format(
        "The scene is too large for the digits of floats: what lies near ({:.6g}, {:.6g}, {:.6g}) "
        "is {:.3g} units from the rest and {:.3g} in size, and loses its shape; {:.2g} % of the "
        "scene do. Bring them nearer to each other, or leave one out.",
        at.x, at.y, at.z, glm::length(torn.middle), 2.0 * torn.size, 100.0 * torn.weight));
}

Scene load_uncompleted(const fs::path& path, const LoadOptions& options) {
    LoadContext context(options);
    Scene scene = load_part(path, context);
    if (!options.animation.empty() && !context.is_animated())
        throw InputError("{}: it has no animations, so none is '{}'; leave --animation away",
                         path.string(), shown(options.animation));
    if (options.at && !context.is_animated())
        scene.notes.push_back("Nothing in the file is animated: it looks the same at any second.");
    if (options.at && context.is_animated()) scene.moment = options.at;
    if (options.environment) {
        scene.environment = *options.environment;
        if (const auto& map = scene.environment.map)
            context.spend(uint64_t(map->width) * map->height, ENVIRONMENT_PIXEL_BYTES,
                          "the environment's map");
    }
    add_daylight(scene, context, path.string());
    bound_environment(scene);
    scene.files = context.files();
    scene.files.push_back(path);
    naming(path, [&] {
        check_scene(scene);
        if (options.stage) count_from(options.stage->origin, scene);
        note_origin(scene);
        note_torn(scene);
        scene.exponent = bring_to_scale(
            scene, options.stage ? std::optional(options.stage->exponent) : std::nullopt);
    });
    return scene;
}

Scene load_scene(const fs::path& path, const LoadOptions& options) {
    Scene scene = load_uncompleted(path, options);
    naming(path, [&] {
        complete_scene(scene, options, is_model(path));
        check_scene(scene); // a framing camera of a scene near the end of float's range
    });
    if (options.texture_filter)
        for (Texture& texture : scene.textures) texture.filter = *options.texture_filter;
    lower_textures(scene, options.texture_memory);
    return scene;
}

} // namespace onde
