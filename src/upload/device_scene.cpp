#include "upload/device_scene.h"

namespace onde {

template <class T>
static gpu::Buffer<T> copy(const gpu::Device& device, const std::vector<T>& v) {
    return gpu::Buffer<T>(device, std::span<const T>(v));
}

DeviceScene::DeviceScene(const gpu::Device& device, PackedScene packed)
    : packed_(std::move(packed)), tree_(device, packed_.bvh),
      surfaces_(copy(device, packed_.surfaces)), materials_(copy(device, packed_.materials)),
      lights_(copy(device, packed_.lights)), textures_(copy(device, packed_.textures.records)),
      texels_(copy(device, packed_.textures.texels)), srgb_(copy(device, packed_.srgb)),
      environment_(copy(device, packed_.environment_map.pixels)),
      environment_alias_(copy(device, packed_.environment_map.alias)) {}

uint32_t DeviceScene::bind(gpu::Kernel& kernel, uint32_t first) const {
    return kernel.set_from(tree_.bind(kernel, first), surfaces_, materials_, lights_, textures_,
                           texels_, srgb_, environment_, environment_alias_);
}

} // namespace onde
