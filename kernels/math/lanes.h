// The width of the code: how many paths one work item shades at once. Nothing else in the tree
// tests ONDE_WIDTH or names float16. At width 1 everything here folds to scalar OpenCL C: read the
// rest of the kernels as if that were all there is.
//
//   real, integer, natural, mask    one float, int, uint, truth value per lane
//   real16, mask16, natural16       sixteen at every width: rays of a stream, children of a node
//   if_any (m) { ... }              runs the block if m holds in some lane
//   choose(m, a, b)                 a where m holds, b elsewhere
//   gather_real(p, i)               p[i] per lane; every lane's index must be valid
//
// A mask comes from a comparison; combine masks with &, | and !, never with ~.
// Arithmetic is exactly as written on every device: no contraction, fma only where it says fma.
#ifndef ONDE_MATH_LANES_H
#define ONDE_MATH_LANES_H

#pragma OPENCL FP_CONTRACT OFF

#ifndef ONDE_WIDTH
    #define ONDE_WIDTH 1
#endif
// Machine instructions: where the host says so and the compiler, which may aim lower, has them.
#if !ONDE_AVX512 || !defined(__AVX512F__) || !defined(__AVX512VL__) || !defined(__AVX512DQ__)
    #undef ONDE_AVX512
    #define ONDE_AVX512 0
#endif
#if !ONDE_AVX2 || !defined(__AVX2__)
    #undef ONDE_AVX2
    #define ONDE_AVX2 0
#endif

#define INLINE static inline __attribute__((always_inline))
// For functions so large that PoCL, which compiles every kernel twice, should not inline them;
// those with a stack also keep it out of the work-item context that way.
#ifndef ONDE_CPU
    #define ONDE_CPU 0
#endif
#if ONDE_CPU
    #define OUTLINED static __attribute__((noinline))
#else
    #define OUTLINED INLINE
#endif
#define OVERLOAD static inline __attribute__((always_inline, overloadable))

#define ONDE_JOIN_(a, b) a##b
#define ONDE_JOIN(a, b) ONDE_JOIN_(a, b)
#if ONDE_WIDTH == 1
    #define ONDE_LANES(type) type
#else
    #define ONDE_LANES(type) ONDE_JOIN(type, ONDE_WIDTH)
#endif

// The position of the lowest set bit. (OpenCL's own ctz came with version 2.)
#if defined(__has_builtin) && ONDE_CPU
    #if __has_builtin(__builtin_ctz)
        #define lowest_bit(bits) ((uint)__builtin_ctz(bits))
    #endif
#endif
#ifndef lowest_bit
    #define lowest_bit(bits) (31u - clz((bits) & (0u - (bits))))
#endif

typedef ONDE_LANES(float) real;
typedef ONDE_LANES(int) integer;
typedef ONDE_LANES(uint) natural;
typedef ONDE_LANES(int) mask;

typedef float16 real16;
typedef int16 mask16;
typedef uint16 natural16;
#define as_real16 as_float16
#define as_mask16 as_int16
#define as_natural16 as_uint16

#define as_real ONDE_LANES(as_float)
#define as_integer ONDE_LANES(as_int)
#define as_natural ONDE_LANES(as_uint)

OVERLOAD real to_real(integer a) {
    return ONDE_LANES(convert_float)(a);
}
OVERLOAD real to_real(natural a) {
    return ONDE_LANES(convert_float)(a);
}
// Toward zero; the value must fit.
INLINE integer to_integer(real a) {
    return ONDE_LANES(convert_int)(a);
}

OVERLOAD real choose(mask m, real a, real b) {
    return m ? a : b;
}
OVERLOAD integer choose(mask m, integer a, integer b) {
    return m ? a : b;
}
OVERLOAD natural choose(mask m, natural a, natural b) {
    return m ? a : b;
}

// Plain comparisons: of a NaN and a number, the second argument.
INLINE real min_real(real a, real b) {
    return choose(a < b, a, b);
}
INLINE real max_real(real a, real b) {
    return choose(a > b, a, b);
}
INLINE real clamp_real(real a, float low, float high) {
    return min_real(max_real(a, (real)(low)), (real)(high));
}

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

// One bit per lane whose sign is set. Signs that are OR-ed together stay in one register, where
// masks of comparisons that are combined are packed to bytes and unpacked again (LLVM 15, AVX2).
INLINE uint sign_bits8(int8 a) {
#if ONDE_AVX512 || ONDE_AVX2
    return bits8(a);
#else
    return bits8(a >> 31);
#endif
}
INLINE uint sign_bits16(int16 a) {
#if ONDE_AVX512
    return bits16(a);
#else
    return sign_bits8(a.lo) | sign_bits8(a.hi) << 8;
#endif
}

#if ONDE_WIDTH == 1

INLINE uint mask_bits(mask m) {
    return m != 0;
}
INLINE natural lane_index(void) {
    return 0;
}
INLINE real load_real(__global const float* p) {
    return *p;
}
INLINE void store_real(__global float* p, real a) {
    *p = a;
}
INLINE void spill_real(float* p, real a) {
    *p = a;
}
INLINE real unspill_real(const float* p) {
    return *p;
}
INLINE natural unspill_natural(const uint* p) {
    return *p;
}
INLINE real gather_real(__global const float* p, natural i) {
    return p[i];
}
INLINE void compress_real(__global float* p, real a, uint bits) {
    if (bits) *p = a;
}

#else

    #define ONDE_VLOAD ONDE_JOIN(vload, ONDE_WIDTH)
    #define ONDE_VSTORE ONDE_JOIN(vstore, ONDE_WIDTH)

INLINE uint mask_bits(mask m) {
    return ONDE_JOIN(bits, ONDE_WIDTH)(m);
}

INLINE natural lane_index(void) {
    #if ONDE_WIDTH == 16
    return (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
    #else
    return (uint8)(0, 1, 2, 3, 4, 5, 6, 7);
    #endif
}

// Lanes from and to consecutive words.
INLINE real load_real(__global const float* p) {
    return ONDE_VLOAD(0, p);
}
INLINE void store_real(__global float* p, real a) {
    ONDE_VSTORE(a, 0, p);
}

// Lanes to and from a private array, for work that goes lane by lane.
INLINE void spill_real(float* p, real a) {
    ONDE_VSTORE(a, 0, p);
}
INLINE real unspill_real(const float* p) {
    return ONDE_VLOAD(0, p);
}
INLINE natural unspill_natural(const uint* p) {
    return ONDE_VLOAD(0, p);
}

    #if ONDE_WIDTH == 16 && ONDE_AVX512
typedef float onde_v16f __attribute__((__vector_size__(64)));
typedef int onde_v16i __attribute__((__vector_size__(64)));

INLINE real gather_real(__global const float* p, natural i) {
    return __builtin_astype(__builtin_ia32_gathersiv16sf(
                                __builtin_astype((real)(0.0f), onde_v16f), (const void*)(size_t)p,
                                __builtin_astype(i, onde_v16i), (ushort)-1, 4),
                            real);
}
// The word at byte `offset` of record i, which has `size` bytes; both are multiples of 4.
INLINE real gather_word(__global const char* records, natural i, uint size, uint offset) {
    return gather_real((__global const float*)(records), i * (size / 4) + offset / 4);
}
    #else
INLINE real gather_real(__global const float* p, natural i) {
    uint index[ONDE_WIDTH];
    float value[ONDE_WIDTH];
    ONDE_VSTORE(i, 0, index);
    for (int k = 0; k < ONDE_WIDTH; k++) value[k] = p[index[k]];
    return ONDE_VLOAD(0, value);
}
// The word at byte `offset` of record i, which has `size` bytes. The address is counted in bytes
// from the record's: compilers take one in words for an index into the record's first array.
INLINE real gather_word(__global const char* records, natural i, uint size, uint offset) {
    uint index[ONDE_WIDTH];
    float value[ONDE_WIDTH];
    ONDE_VSTORE(i, 0, index);
    for (int k = 0; k < ONDE_WIDTH; k++)
        value[k] = *(__global const float*)(records + (size_t)index[k] * size + offset);
    return ONDE_VLOAD(0, value);
}
    #endif

// Stores the lanes of `bits` next to each other at p; touches popcount(bits) words.
INLINE void compress_real(__global float* p, real a, uint bits) {
    #if ONDE_WIDTH == 16 && ONDE_AVX512
    const real packed = __builtin_astype(
        __builtin_ia32_compresssf512_mask(__builtin_astype(a, onde_v16f),
                                          __builtin_astype((real)(0.0f), onde_v16f), (ushort)bits),
        real);
    __builtin_ia32_storeups512_mask((float*)(size_t)p, __builtin_astype(packed, onde_v16f),
                                    (ushort)((1u << popcount(bits)) - 1u));
    #else
    float value[ONDE_WIDTH];
    ONDE_VSTORE(a, 0, value);
    for (; bits; bits &= bits - 1) *p++ = value[lowest_bit(bits)];
    #endif
}

#endif

// p[i] = a for the lanes in `bits`, in their order.
INLINE void scatter_real(__global float* p, natural i, real a, uint bits) {
    float value[ONDE_WIDTH], index[ONDE_WIDTH];
    spill_real(value, a);
    spill_real(index, as_real(i));
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        p[as_uint(index[k])] = value[k];
    }
}

// The lanes whose bit is set.
INLINE mask mask_from_bits(uint bits) {
    return (((natural)(bits) >> lane_index()) & 1u) != 0u;
}

#define if_any(m) if (mask_bits(m))

// 1 in these lanes, 0 in the others.
INLINE natural one_for(mask lanes) {
    return choose(lanes, (natural)(1u), (natural)(0u));
}

INLINE natural load_natural(__global const float* p) {
    return as_natural(load_real(p));
}
// Over all lanes.
INLINE uint sum_natural(natural a) {
    float word[ONDE_WIDTH];
    spill_real(word, as_real(a));
    uint sum = 0;
    for (int k = 0; k < ONDE_WIDTH; k++) sum += as_uint(word[k]);
    return sum;
}
INLINE void store_natural(__global float* p, natural a) {
    store_real(p, as_real(a));
}
INLINE natural gather_natural(__global const uint* p, natural i) {
    return as_natural(gather_real((__global const float*)p, i));
}

// One word of records[i] per lane: RECORD(records, i, Type, field) with a float field,
// RECORD_NATURAL for a uint field. A constant subscript in the field is fine: edge1[2].
#if ONDE_WIDTH == 1
    #define RECORD(records, i, Type, field) as_float((records)[i].field)
    #define RECORD_NATURAL(records, i, Type, field) as_uint((records)[i].field)
#else
    #define RECORD(records, i, Type, field)                                                        \
        gather_word((__global const char*)(records), i, sizeof(Type),                              \
                    __builtin_offsetof(Type, field))
    #define RECORD_NATURAL(records, i, Type, field) as_natural(RECORD(records, i, Type, field))
#endif

#endif
