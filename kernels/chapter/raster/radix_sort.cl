// A stable sort of 32-bit keys with their values, least significant digit first, 8 bits a pass
// (D. Knuth, The Art of Computer Programming 3, 5.2.5). A pass is three kernels: digits are counted
// by block, the counts become places, and every block moves its pairs there in their order.
#include "chapter/raster/scan.h"

#define DIGITS 256u

// Work items of a group, each with 1 KiB of local memory for its block's histogram.
#ifndef ONDE_SORT_GROUP
    #define ONDE_SORT_GROUP 1
#endif
#define SORT_KERNEL __kernel __attribute__((reqd_work_group_size(ONDE_SORT_GROUP, 1, 1)))

INLINE uint digit_of(uint key, uint shift) {
    return key >> shift & (DIGITS - 1u);
}
// Where the group's words hold this work item's for a digit: work items are neighbours, so that
// they use different banks.
INLINE uint own_word(uint digit) {
    return digit * ONDE_SORT_GROUP + (uint)get_local_id(0);
}

// table: by block, then digit. `count` keys, `block` of them per work item.
SORT_KERNEL void count_digits(uint count, uint block, uint shift, __global const uint* keys,
                              __global uint* table) {
    __local uint counts[DIGITS * ONDE_SORT_GROUP];
    const uint begin = min((uint)get_global_id(0) * block, count);
    const uint end = min(begin + block, count);
    if (begin == end) return;
    for (uint d = 0; d < DIGITS; d++) counts[own_word(d)] = 0;
    for (uint i = begin; i < end; i++) counts[own_word(digit_of(keys[i], shift))]++;
    __global uint* row = table + get_global_id(0) * DIGITS;
    for (uint d = 0; d < DIGITS; d++) row[d] = counts[own_word(d)];
}

SORT_KERNEL void move_pairs(uint count, uint block, uint shift, __global const uint* keys,
                            __global const uint* values, __global const uint* table,
                            __global const uint* totals, __global uint* new_keys,
                            __global uint* new_values) {
    __local uint places[DIGITS * ONDE_SORT_GROUP];
    const uint begin = min((uint)get_global_id(0) * block, count);
    const uint end = min(begin + block, count);
    if (begin == end) return;
    __global const uint* row = table + get_global_id(0) * DIGITS;
    uint smaller = 0;
    for (uint d = 0; d < DIGITS; d++) {
        places[own_word(d)] = smaller + row[d];
        smaller += totals[d];
    }
    for (uint i = begin; i < end; i++) {
        const uint place = places[own_word(digit_of(keys[i], shift))]++;
        new_keys[place] = keys[i];
        new_values[place] = values[i];
    }
}
