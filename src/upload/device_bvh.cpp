#include "upload/device_bvh.h"

#include "upload/bvh_arrays.h"

namespace onde {

std::string layout_file(BvhLayout layout) {
    switch (layout) {
    case BvhLayout::compressed:
        return "trace/layout_compressed.h";
    case BvhLayout::binary:
        return "trace/layout_binary.h";
    case BvhLayout::wide:
        break;
    }
    return "trace/layout_wide.h";
}

DeviceBvh::DeviceBvh(const gpu::Device& device, const Bvh& bvh) : root_(bvh.root) {
    const BvhArrays arrays = bvh_arrays(bvh);
#define ONDE_PLACE(Type, name, words) name##_ = gpu::Buffer<Type>::in_place(device, arrays.name);
    BVH_BUFFERS(ONDE_PLACE)
#undef ONDE_PLACE
}

uint32_t DeviceBvh::bind(gpu::Kernel& kernel, uint32_t first) const {
    uint32_t next = first;
#define ONDE_BIND(Type, name, words) kernel.set(next++, name##_);
    BVH_BUFFERS(ONDE_BIND)
#undef ONDE_BIND
    kernel.set(next++, root_);
    return next;
}

} // namespace onde
