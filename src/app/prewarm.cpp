#include "app/prewarm.h"

#include "core/error.h"
#include "scene/load.h"
#include "scene/shapes.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include <fmt/format.h>

#include <cstdio>

namespace onde::app {
namespace {

struct Kind {
    const char* name;
    SceneFeatures features;
    bool large_tree = false; ///< beyond the cache, where rays are interleaved
};

/// A program is compiled for exactly a scene's features; these are sets that many scenes have.
std::vector<Kind> common_kinds() {
    const SceneFeatures spheres{.spheres = true, .dielectrics = true, .stack_size = 64};
    SceneFeatures shapes = spheres;
    shapes.instances = shapes.shapes = true; // a shape is an instance
    const SceneFeatures textured{
        .textures = true, .normal_maps = true, .environment = true, .stack_size = 64};
    SceneFeatures textured_large = textured;
    textured_large.stack_size = 96; // of some ten thousand triangles
    const SceneFeatures everything{.instances = true,
                                   .spheres = true,
                                   .shapes = true,
                                   .textures = true,
                                   .normal_maps = true,
                                   .dielectrics = true,
                                   .environment = true,
                                   .stack_size = 96};
    return {{"spheres in a closed room", spheres},
            {"shapes in a closed room", shapes},
            {"textured glTF, small", textured},
            {"textured glTF, large", textured_large},
            {"textured glTF, huge", textured_large, true},
            {"everything", everything}};
}

Scene one_rectangle() {
    Scene scene;
    scene.materials.emplace_back();
    scene.meshes.push_back(rectangle_mesh({}, {1, 0, 0}, {0, 1, 0}, 0));
    scene.instances.emplace_back();
    complete_scene(scene);
    return scene;
}

void compile(const std::string& name, Machine& machine, Scene scene, SessionOptions options) {
    Session session(machine.programs, std::move(scene), std::move(options));
    const gpu::BuildReport& report = session.prepare();
    fmt::print("{:<26} {} in {:.2f} s\n", name,
               report.from_cache ? "was there, loaded" : "compiled", report.seconds);
    std::fflush(stdout); // the next may take long
}

SessionOptions default_options(const Machine& machine, const Scene& scene) {
    return {.render = resolve_options({}, scene, machine.device.facts()).options};
}

} // namespace

void prewarm(const std::vector<std::string>& scenes, const std::string& device) {
    Machine machine(device);
    if (gpu::ProgramCache::default_folder().empty())
        throw InputError("there is no folder for compiled kernels; set ONDE_CACHE_DIR");
    for (const std::string& path : scenes) {
        Scene scene = load_scene(path);
        SessionOptions options = default_options(machine, scene);
        compile(path, machine, std::move(scene), std::move(options));
    }
    if (!scenes.empty()) return;
    const Scene scene = one_rectangle();
    for (const Kind& kind : common_kinds()) {
        SessionOptions options = default_options(machine, scene);
        options.features = kind.features;
        if (kind.large_tree) options.render.settings.interleave_above = 0;
        compile(kind.name, machine, scene, std::move(options));
    }
}

} // namespace onde::app
