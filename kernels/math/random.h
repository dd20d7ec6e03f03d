// Random numbers as a pure function of (pixel, sample, dimension, seed): Owen-scrambled Sobol
// points in two dimensions, with a new scramble and a new shuffle of the index for each dimension
// pair. No state is carried, so the picture does not depend on who computes what when.
//
// Sobol's first two dimensions need no table: the first is the bit reversal, the second Pascal's
// triangle modulo 2. Scrambling by the Laine-Karras hash (Laine and Karras 2011, Stratified
// Sampling for Stochastic Transparency; Burley 2020, Practical Hash-based Owen Scrambling).
#ifndef ONDE_MATH_RANDOM_H
#define ONDE_MATH_RANDOM_H

#include "math/vector.h"

// Named dimension pairs. Camera first, then four pairs per bounce.
#define DIMENSION_FILTER 0u
#define DIMENSION_LENS 1u
#define DIMENSION_BOUNCES 2u
#define DIMENSION_CHOICE 0u    // x: which light, y: which lobe
#define DIMENSION_LIGHT 1u     // point on the light
#define DIMENSION_DIRECTION 2u // of the BSDF
#define DIMENSION_ROULETTE 3u
#define DIMENSIONS_PER_BOUNCE 4u

INLINE uint bounce_dimension(uint bounce, uint which) {
    return DIMENSION_BOUNCES + bounce * DIMENSIONS_PER_BOUNCE + which;
}

// PCG-RXS-M-XS as a hash (Jarzynski and Olano 2020, Hash Functions for GPU Rendering).
INLINE natural hash_natural(natural v) {
    const natural s = v * 747796405u + 2891336453u;
    const natural w = ((s >> ((s >> 28u) + 4u)) ^ s) * 277803737u;
    return (w >> 22u) ^ w;
}

INLINE natural reverse_bits(natural x) {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return rotate(x, (natural)(16u));
}

// Each bit is flipped by a hash of the bits below it: Owen scrambling of a reversed number.
INLINE natural laine_karras(natural x, natural seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// Bit-reversed second Sobol dimension of an index given in natural order.
INLINE natural sobol_second_reversed(natural v) {
    v ^= (v >> 1) & 0x55555555u;
    v ^= (v >> 2) & 0x33333333u;
    v ^= (v >> 4) & 0x0f0f0f0fu;
    v ^= (v >> 8) & 0x00ff00ffu;
    v ^= v >> 16;
    return v;
}

#define LARGEST_BELOW_ONE 0.99999994f

// In [0, 1), 24 bits.
INLINE real unit_real(natural bits) {
    return to_real(bits >> 8) * 5.9604645e-8f;
}

typedef struct {
    natural pixel; // hash of pixel and seed
    natural index; // of the sample
} Sampler;

// pixel: x | y << 16.
INLINE Sampler sampler_start(natural pixel, natural sample, uint seed) {
    Sampler s;
    s.pixel = hash_natural(pixel + hash_natural((natural)(seed)));
    s.index = sample;
    return s;
}

// Two numbers in [0, 1): over the samples of a pixel, a scrambled (0, 2)-sequence.
INLINE real2 sampler_pair(Sampler s, uint dimension) {
    const natural key = hash_natural(s.pixel ^ (natural)(dimension * 0x9e3779b9u));
    const natural index = reverse_bits(laine_karras(reverse_bits(s.index), key));
    const natural x = reverse_bits(laine_karras(index, hash_natural(key ^ 0xa511e9b3u)));
    const natural y =
        reverse_bits(laine_karras(sobol_second_reversed(index), hash_natural(key ^ 0x63d83595u)));
    return make2(unit_real(x), unit_real(y));
}

#endif
