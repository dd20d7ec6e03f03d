// The stable radix sort of kernels/chapter/raster/radix_sort.cl.
#pragma once

#include "gpu/buffer_list.h"
#include "gpu/program.h"

#include <cstdint>

namespace onde {

/// Room for sorting up to `capacity` pairs.
struct SortBuffers {
    uint32_t block; ///< pairs of one work item
    gpu::Buffer<uint32_t> keys, values, table, totals;

    SortBuffers(gpu::BufferList& buffers, const gpu::DeviceFacts& facts, uint32_t capacity);
};

class RadixSort {
  public:
    /// For up to `capacity` pairs, in work groups of `group`. The programs outlive it.
    RadixSort(gpu::Programs& programs, SortBuffers buffers, uint32_t capacity, uint32_t group);

    /// What suits the device. Each work item of a group takes 1 KiB of local memory, and every
    /// device has 32.
    static uint32_t best_group(const gpu::DeviceFacts& facts);

    /// Queues the sort of the first `count` keys, ascending, with their values; pairs of equal keys
    /// stay in their order.
    void sort(const gpu::Buffer<uint32_t>& keys, const gpu::Buffer<uint32_t>& values,
              uint32_t count, gpu::Profiler* profiler = nullptr);

    const gpu::BuildReport& build_report() const { return program_.report(); }

  private:
    void pass(uint32_t shift, uint32_t count, const gpu::Buffer<uint32_t>* (&pairs)[4],
              gpu::Profiler* profiler);

    SortBuffers buffers_;
    uint32_t capacity_;
    gpu::Program program_;
};

} // namespace onde
