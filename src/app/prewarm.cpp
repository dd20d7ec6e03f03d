#include "app/prewarm.h"

#include "app/render_request.h"
#include "core/error.h"
#include "render/integrator.h"
#include "scene/load.h"
#include "scene/shapes.h"

#include <fmt/format.h>

#include <cstdio>

namespace onde::app {
namespace {

struct Kind {
    const char* name;
    SceneFeatures features;
};

/// A program is compiled for exactly a scene's features; these are sets that many scenes have.
std::vector<Kind> common_kinds() {
    const SceneFeatures shapes{.spheres = true, .dielectrics = true, .stack_size = 64};
    const SceneFeatures textured{
        .textures = true, .normal_maps = true, .environment = true, .stack_size = 64};
    SceneFeatures textured_large = textured;
    textured_large.stack_size = 96; // of some ten thousand triangles
    const SceneFeatures everything{.instances = true,
                                   .spheres = true,
                                   .textures = true,
                                   .normal_maps = true,
                                   .dielectrics = true,
                                   .environment = true,
                                   .stack_size = 96};
    return {{"shapes in a closed room", shapes},
            {"textured glTF, small", textured},
            {"textured glTF, large", textured_large},
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

class Prewarmer {
  public:
    explicit Prewarmer(const std::string& device)
        : device_(gpu::open_device(device)),
          programs_(device_, gpu::KernelSources::embedded(), gpu::ProgramCache()) {
        if (gpu::ProgramCache::default_folder().empty())
            throw InputError("there is no folder for compiled kernels; set ONDE_CACHE_DIR");
    }

    PackedScene pack(const Scene& scene) { return pack_scene(scene, resolve_bvh({}, programs_)); }

    void compile(const std::string& name, const Scene& scene, PackedScene packed) {
        const RenderOptions options = resolve_options({}, scene, device_.facts());
        const DeviceScene device_scene(device_, std::move(packed));
        const auto integrator =
            make_path_integrator(programs_, device_scene, scene.cameras.front(), options);
        const gpu::BuildReport& report = integrator->build_report();
        fmt::print("{:<26} {} in {:.2f} s\n", name,
                   report.from_cache ? "was there, loaded" : "compiled", report.seconds);
        std::fflush(stdout); // the next may take long
    }

  private:
    gpu::Device device_;
    gpu::Programs programs_;
};

} // namespace

void prewarm(const std::vector<std::string>& scenes, const std::string& device) {
    Prewarmer prewarmer(device);
    for (const std::string& path : scenes) {
        const Scene scene = load_scene(path);
        prewarmer.compile(path, scene, prewarmer.pack(scene));
    }
    if (!scenes.empty()) return;
    const Scene scene = one_rectangle();
    const PackedScene packed = prewarmer.pack(scene);
    for (const Kind& kind : common_kinds()) {
        PackedScene as_kind = packed;
        as_kind.features = kind.features;
        as_kind.features.layout = packed.features.layout;
        prewarmer.compile(kind.name, scene, std::move(as_kind));
    }
}

} // namespace onde::app
