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

RadixSort::RadixSort(gpu::Programs& programs, uint32_t capacity, uint32_t local_size)
    : block_(block_size(programs.device().facts())), keys_(programs.device(), capacity),
      values_(programs.device(), capacity),
      table_(programs.device(), size_t(blocks_of(capacity, block_)) * DIGITS),
      totals_(programs.device(), DIGITS),
      program_(programs.build({"chapter/raster/radix_sort.cl",
                               {},
                               {{"count_digits", local_size, blocks_of(capacity, block_)},
                                {"scan_columns", local_size, DIGITS},
                                {"move_pairs", local_size, blocks_of(capacity, block_)}}})) {}

void RadixSort::sort(const gpu::Buffer<uint32_t>& keys, const gpu::Buffer<uint32_t>& values,
                     uint32_t count, gpu::Profiler* profiler) {
    if (count > keys_.size())
        throw DeviceError("a sort for {} pairs was given {}", keys_.size(), count);
    // Four passes, so the pairs end where they were.
    const gpu::Buffer<uint32_t>* pairs[4] = {&keys, &values, &keys_, &values_};
    for (uint32_t shift = 0; shift < 32; shift += DIGIT_BITS) {
        pass(shift, count, pairs, profiler);
        std::swap(pairs[0], pairs[2]);
        std::swap(pairs[1], pairs[3]);
    }
}

void RadixSort::pass(uint32_t shift, uint32_t count, const gpu::Buffer<uint32_t>* (&pairs)[4],
                     gpu::Profiler* profiler) {
    const uint32_t blocks = blocks_of(count, block_);
    gpu::Kernel& counting = program_.kernel("count_digits");
    counting.set_from(0, count, block_, shift, *pairs[0], table_);
    counting.launch(blocks, profiler);
    gpu::Kernel& scan = program_.kernel("scan_columns");
    scan.set_from(0, DIGITS, blocks, table_, totals_);
    scan.launch(blocks > 0 ? DIGITS : 0, profiler);
    gpu::Kernel& move = program_.kernel("move_pairs");
    move.set_from(0, count, block_, shift, *pairs[0], *pairs[1], table_, totals_, *pairs[2],
                  *pairs[3]);
    move.launch(blocks, profiler);
}

uint64_t RadixSort::bytes() const {
    return (keys_.size() + values_.size() + table_.size() + totals_.size()) * sizeof(uint32_t);
}

} // namespace onde
