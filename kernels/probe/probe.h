// How the probes of the tests map functions of lib/ over arrays: one item per lane, each word a
// column of its own (word k of item i is at k * count + i). The host pads `count` to a multiple of
// PROBE_ITEMS, so that groups of every width are full.
#ifndef ONDE_PROBE_PROBE_H
#define ONDE_PROBE_PROBE_H

#include "math/vector.h"
#include "shared/items.h"

typedef struct {
    __global const float* in;
    __global float* out;
    uint count;
    uint first; // item of lane 0
} Items;

INLINE real input(Items items, uint k) {
    return load_real(items.in + (size_t)k * items.count + items.first);
}
INLINE natural input_natural(Items items, uint k) {
    return as_natural(input(items, k));
}
INLINE mask input_mask(Items items, uint k) {
    return input(items, k) != 0.0f;
}
INLINE real2 input2(Items items, uint k) {
    return make2(input(items, k), input(items, k + 1));
}
INLINE real3 input3(Items items, uint k) {
    return make3(input(items, k), input(items, k + 1), input(items, k + 2));
}
// The word of the first item, for parameters that are the same in all lanes.
INLINE uint input_uniform(Items items, uint k) {
    return as_uint(items.in[(size_t)k * items.count]);
}

OVERLOAD void output(Items items, uint k, real a) {
    store_real(items.out + (size_t)k * items.count + items.first, a);
}
OVERLOAD void output(Items items, uint k, natural a) {
    output(items, k, as_real(a));
}
OVERLOAD void output(Items items, uint k, real2 a) {
    output(items, k, a.x);
    output(items, k + 1, a.y);
}
OVERLOAD void output(Items items, uint k, real3 a) {
    output(items, k, a.x);
    output(items, k + 1, a.y);
    output(items, k + 2, a.z);
}
INLINE void output_mask(Items items, uint k, mask m) {
    output(items, k, choose(m, (real)(1.0f), (real)(0.0f)));
}

INLINE Items probe_items(uint count, __global const float* in, __global float* out, uint first) {
    Items items;
    items.in = in;
    items.out = out;
    items.count = count;
    items.first = first;
    return items;
}

// PROBE(name) { ... items ... } is a kernel probe_name that runs the block over groups of items.
#define PROBE(name)                                                                                \
    INLINE void name##_of(Items items);                                                            \
    __kernel void probe_##name(uint count, __global const float* in, __global float* out) {        \
        const uint first = get_global_id(0) * PROBE_ITEMS;                                         \
        if (first >= count) return;                                                                \
        for (uint i = first; i < first + PROBE_ITEMS; i += ONDE_WIDTH)                             \
            name##_of(probe_items(count, in, out, i));                                             \
    }                                                                                              \
    INLINE void name##_of(Items items)

#endif
