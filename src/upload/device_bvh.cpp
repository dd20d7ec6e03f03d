#include "upload/device_bvh.h"

namespace onde {
namespace {

using Bytes = gpu::Buffer<uint8_t>;

template <class T>
Bytes in_place(const gpu::Device& device, const AlignedVector<T>& values) {
    const auto* bytes = reinterpret_cast<const uint8_t*>(values.data());
    return Bytes::in_place(device, {bytes, sizeof(T) * values.size()});
}

Bytes nodes_in_place(const gpu::Device& device, const Bvh& bvh) {
    switch (bvh.layout) {
    case BvhLayout::compressed:
        return in_place(device, bvh.compressed);
    case BvhLayout::binary:
        return in_place(device, bvh.pairs);
    case BvhLayout::wide:
        break;
    }
    return in_place(device, bvh.nodes);
}

Bytes leaves_in_place(const gpu::Device& device, const Bvh& bvh) {
    return bvh.layout == BvhLayout::wide ? in_place(device, bvh.blocks)
                                         : in_place(device, bvh.slots);
}

} // namespace

DeviceBvh::DeviceBvh(const gpu::Device& device, const Bvh& bvh)
    : nodes_(nodes_in_place(device, bvh)), leaves_(leaves_in_place(device, bvh)),
      spheres_(gpu::Buffer<BvhSphere>::in_place(device, bvh.spheres)),
      instances_(gpu::Buffer<BvhInstance>::in_place(device, bvh.instances)), root_(bvh.root) {}

uint32_t DeviceBvh::bind(gpu::Kernel& kernel, uint32_t first) const {
    return kernel.set_from(first, nodes_, leaves_, spheres_, instances_, root_);
}

} // namespace onde
