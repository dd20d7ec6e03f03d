// Vectors on huge-page boundaries, so that a CPU device can use host memory in place.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <new>
#include <vector>

namespace onde {

/// Allocates on 2 MiB boundaries and asks for huge pages when the block is that large, else on
/// 4 KiB boundaries.
void* allocate_aligned(size_t bytes);

template <class T>
struct HugePageAllocator {
    using value_type = T;
    HugePageAllocator() = default;
    template <class U>
    HugePageAllocator(const HugePageAllocator<U>&) {}
    T* allocate(size_t count) { return static_cast<T*>(allocate_aligned(count * sizeof(T))); }
    void deallocate(T* pointer, size_t) { std::free(pointer); }
    template <class U>
    bool operator==(const HugePageAllocator<U>&) const {
        return true;
    }
};

template <class T>
using AlignedVector = std::vector<T, HugePageAllocator<T>>;

} // namespace onde
