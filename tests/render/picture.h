// A scene rendered on the tests' device, in one call.
#pragma once

#include "doctor/furnaces.h"
#include "scene/load.h"
#include "session/integrators.h"
#include "session/session.h"
#include "support/all_features.h"
#include "support/assets.h"
#include "support/folders.h"
#include "support/probe.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <atomic>
#include <filesystem>
#include <vector>

namespace onde::test {

using doctor::camera_at;

struct Picture {
    Image image;
    RayCounts rays;
    Film::Invalid invalid;
    RenderOutcome outcome;
};

/// Options for small, quick pictures; the device's settings.
inline RenderOptions small_options(uint32_t width, uint32_t height, uint32_t samples) {
    RenderOptions options;
    options.width = width;
    options.height = height;
    options.samples = samples;
    options.filter = Filter::box;
    options.settings = gpu::default_settings(device().facts());
    return options;
}

inline Picture take_picture(Integrator& integrator, const RenderOptions& options) {
    const std::atomic<bool> never{false};
    Picture picture;
    picture.outcome = render(integrator, options, never, [](const Progress&) {});
    picture.image = integrator.film().develop();
    picture.rays = integrator.ray_counts();
    picture.invalid = integrator.film().find_invalid();
    return picture;
}

/// By the integrator that the options name. `placed` is `scene` on the device.
inline Picture render_by(const Scene& scene, const DeviceScene& placed,
                         const RenderOptions& options) {
    const Camera& camera = scene.cameras.at(options.camera);
    return take_picture(*make_integrator({programs(), &scene, placed, camera, options, nullptr}),
                        options);
}

/// The same, but for what only some scenes ask of surfaces and textures: as `own` has it.
inline SceneFeatures all_features(const SceneFeatures& own) {
    SceneFeatures features = all_features();
    features.alpha = own.alpha;
    features.culling = own.culling;
    features.ground = own.ground;
    features.uv_sets = own.uv_sets;
    features.texture_transforms = own.texture_transforms;
    features.nearest_filters = own.nearest_filters;
    features.wide_textures = own.wide_textures;
    features.vertex_colors = own.vertex_colors;
    features.light_tree = own.light_tree;
    features.media = own.media;
    features.glow = own.glow;
    features.grids = own.grids;
    return features;
}

/// A complete scene (see complete_scene) on the device, with kernels that can do everything.
inline DeviceScene place_on_device(const Scene& scene) {
    PackedScene packed = pack_scene(scene);
    packed.features = all_features(packed.features);
    return DeviceScene(device(), std::move(packed));
}

inline Picture render_scene(const Scene& scene, const RenderOptions& options) {
    check_scene(scene);
    const SceneFeatures features = all_features(pack_scene(scene).features);
    Session session(programs(), scene,
                    {.render = options, .choose_layout = false, .features = features});
    const RenderOutcome outcome = session.render();
    return {session.picture(), session.ray_counts(), session.film().find_invalid(), outcome};
}

/// The scene files of the project, in alphabetical order, without the parts that they include.
inline std::vector<std::filesystem::path> project_scenes() {
    std::vector<std::filesystem::path> scenes;
    const auto folder = std::filesystem::path(in_project("scenes"));
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
        if (entry.path().extension() == ".toml" && entry.path().parent_path().filename() != "parts")
            scenes.push_back(entry.path());
    std::ranges::sort(scenes);
    return scenes;
}

} // namespace onde::test
