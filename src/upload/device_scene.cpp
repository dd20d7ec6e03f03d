#include "upload/device_scene.h"

namespace onde {

DeviceScene::DeviceScene(const gpu::Device& device, PackedScene packed)
    : packed_(std::move(packed)), tree_(device, packed_.bvh) {
#define ONDE_COPY(Type, name, words)                                                               \
    name##_ = gpu::Buffer<Type>(device, std::span<const Type>(packed_.name));
    PACKED_BUFFERS(ONDE_COPY)
#undef ONDE_COPY
}

void DeviceScene::update(const gpu::Device& device, const Scene& scene, SceneChange change,
                         const BvhOptions& options, const LightOptions& lights) {
    // What is packed anew lies elsewhere in the host's memory.
#define ONDE_REMEMBER(Type, name, words) const Type* const name##_before = packed_.name.data();
    PACKED_BUFFERS(ONDE_REMEMBER)
#undef ONDE_REMEMBER
    repack_scene(packed_, scene, change, options, lights);
#define ONDE_COPY_NEW(Type, name, words)                                                           \
    if (packed_.name.data() != name##_before)                                                      \
        name##_ = gpu::Buffer<Type>(device, std::span<const Type>(packed_.name));
    PACKED_BUFFERS(ONDE_COPY_NEW)
#undef ONDE_COPY_NEW
    if (change >= SceneChange::transforms) tree_ = DeviceBvh(device, packed_.bvh);
}

uint32_t DeviceScene::bind(gpu::Kernel& kernel, uint32_t first) const {
    uint32_t next = tree_.bind(kernel, first);
#define ONDE_BIND(Type, name, words) kernel.set(next++, name##_);
    SCENE_BUFFERS(ONDE_BIND)
    if (packed_.features.motion) {
        MOTION_BUFFERS(ONDE_BIND)
    }
    if (packed_.features.split_texels) {
        MORE_TEXEL_BUFFERS(ONDE_BIND)
    }
    if (packed_.features.mip_textures) {
        MIP_BUFFERS(ONDE_BIND)
    }
#undef ONDE_BIND
    return next;
}

} // namespace onde
