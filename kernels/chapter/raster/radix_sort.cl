// A stable sort of 32-bit keys with their values, least significant digit first, 8 bits a pass
// (D. Knuth, The Art of Computer Programming 3, 5.2.5). A pass is three kernels: digits are counted
// by block, the counts become places, and every block moves its pairs there in their order.
#include "chapter/raster/scan.h"

#define DIGITS 256u

INLINE uint digit_of(uint key, uint shift) {
    return key >> shift & (DIGITS - 1u);
}

// table: by block, then digit. `count` keys, `block` of them per work item.
__kernel void count_digits(uint count, uint block, uint shift, __global const uint* keys,
                           __global uint* table) {
    const uint begin = min((uint)get_global_id(0) * block, count);
    const uint end = min(begin + block, count);
    if (begin == end) return;
    uint counts[DIGITS];
    for (uint d = 0; d < DIGITS; d++) counts[d] = 0;
    for (uint i = begin; i < end; i++) counts[digit_of(keys[i], shift)]++;
    __global uint* row = table + get_global_id(0) * DIGITS;
    for (uint d = 0; d < DIGITS; d++) row[d] = counts[d];
}

__kernel void move_pairs(uint count, uint block, uint shift, __global const uint* keys,
                         __global const uint* values, __global const uint* table,
                         __global const uint* totals, __global uint* new_keys,
                         __global uint* new_values) {
    const uint begin = min((uint)get_global_id(0) * block, count);
    const uint end = min(begin + block, count);
    if (begin == end) return;
    __global const uint* row = table + get_global_id(0) * DIGITS;
    uint places[DIGITS], smaller = 0;
    for (uint d = 0; d < DIGITS; d++) {
        places[d] = smaller + row[d];
        smaller += totals[d];
    }
    for (uint i = begin; i < end; i++) {
        const uint place = places[digit_of(keys[i], shift)]++;
        new_keys[place] = keys[i];
        new_values[place] = values[i];
    }
}
