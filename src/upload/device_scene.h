// The scene's buffers on the device. Owns them, binds them, knows nothing of frames or waves.
#pragma once

#include "gpu/buffer.h"
#include "gpu/program.h"
#include "upload/device_bvh.h"
#include "upload/pack.h"

namespace onde {

/// Keeps the packed scene alive, since a CPU device uses its memory in place. Move-only.
class DeviceScene {
  public:
    DeviceScene(const gpu::Device& device, PackedScene packed);

    const PackedScene& packed() const { return packed_; }

    /// Takes over what has changed in the scene since it was packed; see repack_scene(). No kernel
    /// may be running. What was bound before is to be bound again.
    void update(const gpu::Device& device, const Scene& scene, SceneChange change,
                const BvhOptions& options, const LightOptions& lights);
    /// Replaces what kernels are compiled for; it must cover the scene.
    void set_features(const SceneFeatures& features) { packed_.features = features; }
    /// Where a camera of the scene has become orthographic; it is not in what is bound.
    void set_bounds(const Scene& scene) { packed_.bounds = bounds_for_parallel_rays(scene); }
    /// Turns the environment's map, radians; it is not in what is bound.
    void set_environment_rotation(float radians) { packed_.environment_rotation = radians; }
    uint64_t bvh_bytes() const { return tree_.bytes(); }

    /// Binds the scene's parameters of a kernel (SCENE_PARAMETERS of kernels/shade/scene_view.h but
    /// for the first, the frame) from argument `first` on; returns the next index.
    uint32_t bind(gpu::Kernel& kernel, uint32_t first) const;

  private:
    PackedScene packed_;
    DeviceBvh tree_;
#define ONDE_BUFFER(Type, name, words) gpu::Buffer<Type> name##_;
    SCENE_BUFFERS(ONDE_BUFFER)
#undef ONDE_BUFFER
};

} // namespace onde
