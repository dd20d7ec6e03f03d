#include "build_heap.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstddef>
#include <malloc.h>

namespace {

std::atomic<bool> counting{false};
std::atomic<int64_t> taken{0}, most{0};

void* count(void* block) {
    if (!block || !counting.load(std::memory_order_relaxed)) return block;
    const int64_t now = taken += int64_t(malloc_usable_size(block));
    for (int64_t seen = most; seen < now && !most.compare_exchange_weak(seen, now);) {
    }
    return block;
}

void discount(void* block) {
    if (block && counting.load(std::memory_order_relaxed))
        taken -= int64_t(malloc_usable_size(block));
}

} // namespace

// glibc lets a program define these (its manual, "Replacing malloc") and keeps its own under other
// names.
extern "C" {
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void __libc_free(void*);

void* malloc(size_t bytes) {
    return count(__libc_malloc(bytes));
}
void* calloc(size_t number, size_t bytes) {
    return count(__libc_calloc(number, bytes));
}
void* realloc(void* block, size_t bytes) {
    discount(block);
    return count(__libc_realloc(block, bytes));
}
void* memalign(size_t alignment, size_t bytes) {
    return count(__libc_memalign(alignment, bytes));
}
void* aligned_alloc(size_t alignment, size_t bytes) {
    return count(__libc_memalign(alignment, bytes));
}
int posix_memalign(void** block, size_t alignment, size_t bytes) {
    *block = count(__libc_memalign(alignment, bytes));
    return *block ? 0 : ENOMEM;
}
void free(void* block) {
    discount(block);
    __libc_free(block);
}
}

namespace onde::bench {

HeapMeter::HeapMeter() {
    taken = most = 0;
    counting = true;
}

HeapMeter::~HeapMeter() {
    counting = false;
}

uint64_t HeapMeter::peak_bytes() const {
    return uint64_t(most);
}

} // namespace onde::bench
