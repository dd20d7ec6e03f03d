// A scene and its acceleration structure as device records, still in host memory. Pure.
#pragma once

#include "accel/bvh.h"
#include "gpu/buffer_list.h"
#include "scene/scene.h"
#include "shared/frame.h"
#include "upload/appearance.h"
#include "upload/lights.h"

#include <string>
#include <vector>

namespace onde {

/// What a scene needs of the kernels; the rest is not compiled.
struct SceneFeatures {
    bool instances = false, spheres = false, shapes = false, textures = false, normal_maps = false;
    bool dielectrics = false, environment = false;
    uint32_t stack_size = 1;
    bool watertight = false;
    BvhLayout layout = BvhLayout::wide;

    /// As definitions for the kernels: "ONDE_TEXTURES=1", ...
    std::vector<std::string> defines() const;
};

struct PackedScene {
    Bvh bvh;
    std::vector<SurfaceRecord> surfaces;
    std::vector<MaterialRecord> materials;
    std::vector<LightRecord> lights;
    uint32_t environment_light = NO_INDEX;
    PackedTextures textures;
    std::vector<float> srgb;
    Environment environment; ///< without its map: scale and rotation
    PackedEnvironment environment_map;
    SceneFeatures features;

    /// The buffers that the scene takes on the device.
    std::vector<gpu::BufferSize> device_buffers() const;
    /// Their sum.
    uint64_t device_bytes() const { return gpu::total_bytes(device_buffers()); }
};

/// The scene must satisfy check_scene().
PackedScene pack_scene(const Scene& scene, const BvhOptions& options = {});

} // namespace onde
