#include "chapter/raster_sort.h"

#include "core/error.h"

#include <utility>

namespace onde {
namespace {

constexpr uint32_t DIGITS = 256, DIGIT_BITS = 8;

/// Pairs of one work item: fewer leave more work items, more spend less on the table.
uint32_t block_size(const gpu::DeviceFacts& facts) {
    return facts.is_cpu ? 16384 : 1024;
}

uint32_t blocks_of(uint32_t count, uint32_t block) {
    return uint32_t((uint64_t(count) + block - 1) / block);
}

} // namespace

SortBuffers::SortBuffers(gpu::BufferList& buffers, const gpu::DeviceFacts& facts, uint32_t capacity)
    : block(block_size(facts)), keys(buffers.add<uint32_t>("sort keys", capacity)),
      values(buffers.add<uint32_t>("sort values", capacity)),
      table(buffers.add<uint32_t>("sort table", size_t(blocks_of(capacity, block)) * DIGITS)),
      totals(buffers.add<uint32_t>("sort totals", DIGITS)) {}

RadixSort::RadixSort(gpu::Programs& programs, SortBuffers buffers, uint32_t capacity,
                     uint32_t group)
    : buffers_(std::move(buffers)), capacity_(capacity),
      program_(programs.build({"chapter/raster/radix_sort.cl",
                               {fmt::format("ONDE_SORT_GROUP={}", group)},
                               {{"count_digits", group, blocks_of(capacity, buffers_.block)},
                                {"scan_columns", group, DIGITS},
                                {"move_pairs", group, blocks_of(capacity, buffers_.block)}}})) {}

uint32_t RadixSort::best_group(const gpu::DeviceFacts& facts) {
    return facts.is_cpu ? 1 : 16;
}

void RadixSort::sort(const gpu::Buffer<uint32_t>& keys, const gpu::Buffer<uint32_t>& values,
                     uint32_t count, gpu::Profiler* profiler) {
    if (count > capacity_) throw DeviceError("a sort for {} pairs was given {}", capacity_, count);
    // Four passes, so the pairs end where they were.
    const gpu::Buffer<uint32_t>* pairs[4] = {&keys, &values, &buffers_.keys, &buffers_.values};
    for (uint32_t shift = 0; shift < 32; shift += DIGIT_BITS) {
        pass(shift, count, pairs, profiler);
        std::swap(pairs[0], pairs[2]);
        std::swap(pairs[1], pairs[3]);
    }
}

void RadixSort::pass(uint32_t shift, uint32_t count, const gpu::Buffer<uint32_t>* (&pairs)[4],
                     gpu::Profiler* profiler) {
    const uint32_t blocks = blocks_of(count, buffers_.block);
    gpu::Kernel& counting = program_.kernel("count_digits");
    counting.set_from(0, count, buffers_.block, shift, *pairs[0], buffers_.table);
    counting.launch(blocks, profiler);
    gpu::Kernel& scan = program_.kernel("scan_columns");
    scan.set_from(0, DIGITS, blocks, buffers_.table, buffers_.totals);
    scan.launch(blocks > 0 ? DIGITS : 0, profiler);
    gpu::Kernel& move = program_.kernel("move_pairs");
    move.set_from(0, count, buffers_.block, shift, *pairs[0], *pairs[1], buffers_.table,
                  buffers_.totals, *pairs[2], *pairs[3]);
    move.launch(blocks, profiler);
}

} // namespace onde
