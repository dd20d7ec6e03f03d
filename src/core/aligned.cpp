#include "core/aligned.h"

#include <sys/mman.h>

namespace onde {

void* allocate_aligned(size_t bytes) {
    constexpr size_t HUGE_PAGE = size_t(2) << 20, PAGE = 4096;
    const size_t alignment = bytes >= HUGE_PAGE ? HUGE_PAGE : PAGE;
    const size_t rounded = (bytes + alignment - 1) / alignment * alignment;
    void* pointer = std::aligned_alloc(alignment, rounded ? rounded : alignment);
    if (!pointer) throw std::bad_alloc();
    if (alignment == HUGE_PAGE) madvise(pointer, rounded, MADV_HUGEPAGE); // a hint; may be refused
    return pointer;
}

} // namespace onde
