#include "upload/bvh_arrays.h"

namespace onde {

template <class T>
static std::span<const uchar> bytes_of(const AlignedVector<T>& values) {
    return {reinterpret_cast<const uchar*>(values.data()), sizeof(T) * values.size()};
}

BvhArrays bvh_arrays(const Bvh& bvh) {
    BvhArrays arrays;
    arrays.spheres = bvh.spheres;
    arrays.instances = bvh.instances;
    switch (bvh.layout) {
    case BvhLayout::wide:
        arrays.nodes = bytes_of(bvh.nodes);
        arrays.blocks = bytes_of(bvh.blocks);
        break;
    case BvhLayout::compressed:
        arrays.nodes = bytes_of(bvh.compressed);
        arrays.blocks = bytes_of(bvh.slots);
        break;
    case BvhLayout::binary:
        arrays.nodes = bytes_of(bvh.pairs);
        arrays.blocks = bytes_of(bvh.slots);
        break;
    }
    return arrays;
}

} // namespace onde
