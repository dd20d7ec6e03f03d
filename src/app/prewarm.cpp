#include "app/prewarm.h"

#include "core/error.h"
#include "scene/load.h"
#include "scene/shapes.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"
#include "upload/common_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>

namespace onde::app {
namespace {

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
    fmt::print("{:<32} {} in {:.2f} s\n", name,
               report.from_cache ? "was there, loaded" : "compiled", report.seconds);
    std::fflush(stdout); // the next may take long
}

/// Of a render that needs all programs: a film of several blocks has one of its own.
SessionOptions default_options(const Machine& machine, const Scene& scene) {
    RenderOptions options = resolve_options({}, scene, machine.device.facts()).options;
    options.samples = std::max(options.samples, FILM_BLOCK + 1);
    return {.render = options};
}

} // namespace

void prewarm(const std::vector<std::string>& scenes, const std::string& device,
             const LoadOptions& load) {
    Machine machine(device);
    if (gpu::ProgramCache::default_folder().empty())
        throw InputError("there is no folder for compiled kernels; set ONDE_CACHE_DIR");
    for (const std::string& path : scenes) {
        Scene scene = load_scene(path, load);
        SessionOptions options = default_options(machine, scene);
        compile(path, machine, std::move(scene), std::move(options));
    }
    if (!scenes.empty()) return;
    const Scene scene = one_rectangle();
    for (const CommonFeatures& kind : common_features()) {
        SessionOptions options = default_options(machine, scene);
        options.features = kind.features;
        if (kind.beyond_cache) options.render.settings.interleave_above = 0;
        compile(kind.name, machine, scene, std::move(options));
    }
}

} // namespace onde::app
