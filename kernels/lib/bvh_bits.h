// Fixed-width lanes for traversal, whose width is that of the tree and not that of shading: bit
// masks, plain minima, and the machine instructions that PoCL has for them.
#ifndef ONDE_LIB_BVH_BITS_H
#define ONDE_LIB_BVH_BITS_H

#include "lib/lanes.h"
#include "shared/bvh.h"

#ifndef ONDE_CPU
    #define ONDE_CPU 0
#endif

// On PoCL a function of its own keeps the stack out of the work-item context; GPUs want it inline.
#if ONDE_CPU
    #define TRAVERSAL static __attribute__((noinline))
#else
    #define TRAVERSAL static inline
#endif

// Written as comparisons: fmin and fmax order NaN, which costs a tenth of the traversal rate.
#define LOWER(a, b) ((a) < (b) ? (a) : (b))
#define UPPER(a, b) ((a) > (b) ? (a) : (b))

// One bit per lane of a comparison's result, lane 0 lowest.
INLINE uint bits8(int8 m) {
#if ONDE_AVX512
    return (uint)(uchar)__builtin_ia32_cvtd2mask256(m);
#elif ONDE_AVX2
    return (uint)__builtin_ia32_movmskps256(as_float8(m));
#else
    const int8 bits = m & (int8)(1, 2, 4, 8, 16, 32, 64, 128);
    const int4 four = bits.lo | bits.hi;
    const int2 two = four.lo | four.hi;
    return (uint)(two.x | two.y);
#endif
}
INLINE uint bits16(int16 m) {
#if ONDE_AVX512
    return (uint)(ushort)__builtin_ia32_cvtd2mask512(m);
#else
    return bits8(m.lo) | bits8(m.hi) << 8;
#endif
}

// One bit per lane where a <= b.
INLINE uint lower_bits16(float16 a, float16 b) {
#if ONDE_AVX512
    return (uint)(ushort)__builtin_ia32_cmpps512_mask(a, b, 18, (ushort)-1, 4);
#else
    return bits16(a <= b);
#endif
}

INLINE float lowest_of8(float8 a) {
    const float4 four = LOWER(a.lo, a.hi);
    const float2 two = LOWER(four.lo, four.hi);
    return LOWER(two.x, two.y);
}
INLINE float lowest_of16(float16 a) {
    return lowest_of8(LOWER(a.lo, a.hi));
}
INLINE float highest_of16(float16 a) {
    return -lowest_of16(-a);
}

// Asks for a leaf block, or the first lines of a node, before it is needed. (In a loop, PoCL would
// leave the loop in.)
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

#endif
