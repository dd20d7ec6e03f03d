// Fixed-width lanes for traversal, whose width is that of the tree and not that of shading: bit
// masks, plain minima, and the machine instructions that PoCL has for them.
#ifndef ONDE_TRACE_BVH_BITS_H
#define ONDE_TRACE_BVH_BITS_H

#include "math/lanes.h"
#include "shared/bvh.h"

// Whether leaf blocks hold corners, and are tested so that no ray slips between triangles that
// share an edge or a corner (Bvh::watertight).
#ifndef ONDE_WATERTIGHT
    #define ONDE_WATERTIGHT 0
#endif

// Written as comparisons: fmin and fmax order NaN, which costs a tenth of the traversal rate.
#define min_fast(a, b) ((a) < (b) ? (a) : (b))
#define max_fast(a, b) ((a) > (b) ? (a) : (b))

// The lanes whose bit is set.
INLINE mask16 lanes16(uint bits) {
    const mask16 places = (mask16)(0x1, 0x2, 0x4, 0x8, 0x10, 0x20, 0x40, 0x80, 0x100, 0x200, 0x400,
                                   0x800, 0x1000, 0x2000, 0x4000, 0x8000);
    return ((mask16)((int)bits) & places) != 0;
}

// One bit per lane where a <= b.
INLINE uint lower_bits16(real16 a, real16 b) {
#if ONDE_AVX512
    return (uint)(ushort)__builtin_ia32_cmpps512_mask(a, b, 18, (ushort)-1, 4);
#else
    return bits16(a <= b);
#endif
}

INLINE float lowest_of8(float8 a) {
    const float4 four = min_fast(a.lo, a.hi);
    const float2 two = min_fast(four.lo, four.hi);
    return min_fast(two.x, two.y);
}
INLINE float lowest_of16(real16 a) {
    return lowest_of8(min_fast(a.lo, a.hi));
}
INLINE float highest_of16(real16 a) {
    return -lowest_of16(-a);
}

// Asks for the five lines of a leaf block before it is needed, or the seven of a node. (In a loop,
// PoCL would leave the loop in.)
INLINE void prefetch_block(__global const uchar* p) {
#if ONDE_AVX2 || ONDE_AVX512
    const void* line = (const void*)(size_t)p;
    __builtin_prefetch(line);
    __builtin_prefetch(line + 64);
    __builtin_prefetch(line + 128);
    __builtin_prefetch(line + 192);
    __builtin_prefetch(line + 256);
#endif
}
INLINE void prefetch_node(__global const uchar* p) {
    prefetch_block(p);
#if ONDE_AVX2 || ONDE_AVX512
    const void* line = (const void*)(size_t)(p + 320);
    __builtin_prefetch(line);
    __builtin_prefetch(line + 64);
#endif
}

#endif
