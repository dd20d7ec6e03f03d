#include "upload/device_scene.h"

namespace onde {

DeviceScene::DeviceScene(const gpu::Device& device, PackedScene packed)
    : packed_(std::move(packed)), tree_(device, packed_.bvh) {
#define ONDE_COPY(Type, name, words)                                                               \
    name##_ = gpu::Buffer<Type>(device, std::span<const Type>(packed_.name));
    SCENE_BUFFERS(ONDE_COPY)
#undef ONDE_COPY
}

uint32_t DeviceScene::bind(gpu::Kernel& kernel, uint32_t first) const {
    uint32_t next = tree_.bind(kernel, first);
#define ONDE_BIND(Type, name, words) kernel.set(next++, name##_);
    SCENE_BUFFERS(ONDE_BIND)
#undef ONDE_BIND
    return next;
}

} // namespace onde
