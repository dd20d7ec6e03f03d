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
#define DIMENSION_CHOICE 0u    // x: which of many lights, y: which lobe
#define DIMENSION_LIGHT 1u     // point on the light
#define DIMENSION_DIRECTION 2u // of the BSDF
#define DIMENSION_ROULETTE 3u  // y: which of the surfaces that let rays pass ends the next ray
#define DIMENSIONS_PER_BOUNCE 4u
#define DIMENSION_MEDIA 0x20000000u      // and bounce: what a ray meets on its way
#define DIMENSION_CONNECTION 0x28000000u // and bounce: what a connection meets
#define DIMENSION_WAVELENGTH 0x3fffffffu // of light that is dispersed; no bounce has it

INLINE uint bounce_dimension(uint bounce, uint which) {
    return DIMENSION_BOUNCES + bounce * DIMENSIONS_PER_BOUNCE + which;
}

INLINE uint media_dimension(uint bounce) {
    return DIMENSION_MEDIA + bounce;
}

INLINE uint connection_dimension(uint bounce) {
    return DIMENSION_CONNECTION + bounce;
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

// The third and fourth dimensions (Joe and Kuo 2008), as columns of bit-reversed matrices.
__constant uint SOBOL_REVERSED[2][32] = {
    {0x00000001u, 0x00000003u, 0x00000006u, 0x00000009u, 0x00000017u, 0x0000003au, 0x00000071u,
     0x000000a3u, 0x00000116u, 0x00000339u, 0x00000677u, 0x000009aau, 0x00001601u, 0x00003903u,
     0x00007706u, 0x0000aa09u, 0x00010117u, 0x0003033au, 0x00060671u, 0x000909a3u, 0x00171616u,
     0x003a3939u, 0x00717777u, 0x00a3aaaau, 0x01170001u, 0x033a0003u, 0x06710006u, 0x09a30009u,
     0x16160017u, 0x3939003au, 0x77770071u, 0xaaaa00a3u},
    {0x00000001u, 0x00000003u, 0x00000004u, 0x0000000au, 0x0000001fu, 0x0000002eu, 0x00000045u,
     0x000000c9u, 0x0000011bu, 0x000002a4u, 0x0000079au, 0x00000b67u, 0x0000101eu, 0x0000302du,
     0x00004041u, 0x0000a0c3u, 0x0001f104u, 0x0002e28au, 0x000457dfu, 0x000c9baeu, 0x0011a105u,
     0x002a7289u, 0x0079e7dbu, 0x00b6dba4u, 0x0100011au, 0x030002a7u, 0x0400079eu, 0x0a000b6du,
     0x1f001001u, 0x2e003003u, 0x45004004u, 0xc900a00au}};

INLINE natural sobol_reversed(natural index, uint dimension) {
    natural reversed = (natural)(0u);
    for (uint k = 0; k < 32; k++)
        reversed ^= (0u - ((index >> k) & 1u)) & SOBOL_REVERSED[dimension - 2][k];
    return reversed;
}

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

// A scramble and a shuffle of the samples' indices.
typedef struct {
    natural key, index;
} Shuffled;
INLINE Shuffled shuffle_samples(Sampler s, uint dimension) {
    Shuffled shuffled;
    shuffled.key = hash_natural(s.pixel ^ (natural)(dimension * 0x9e3779b9u));
    shuffled.index = reverse_bits(laine_karras(reverse_bits(s.index), shuffled.key));
    return shuffled;
}
INLINE real2 scrambled_pair(natural x, natural y, natural key) {
    x = reverse_bits(laine_karras(x, hash_natural(key ^ 0xa511e9b3u)));
    y = reverse_bits(laine_karras(y, hash_natural(key ^ 0x63d83595u)));
    return make2(unit_real(x), unit_real(y));
}

// Numbers in [0, 1) of a dimension that needs nobody knows how many, by their place. They know
// nothing of each other, nor of other samples' ones.
INLINE natural stream_key(Sampler s, uint dimension) {
    return hash_natural(s.pixel ^ hash_natural(s.index ^ (natural)(dimension * 0x9e3779b9u)));
}
INLINE real stream_real(natural key, natural place) {
    return unit_real(hash_natural(key + place * 0x9e3779b9u));
}

// Two numbers in [0, 1): over the samples of a pixel, a scrambled (0, 2)-sequence. The direction at
// the first vertex continues the sequence of the place in the pixel, with which it is entangled
// most, in dimensions 3 and 4, which by themselves are stratified less finely than a (0,
// 2)-sequence. The other pairs know nothing of each other.
INLINE real2 sampler_pair(Sampler s, uint dimension) {
    if (dimension == bounce_dimension(0, DIMENSION_DIRECTION)) {
        const Shuffled first = shuffle_samples(s, DIMENSION_FILTER);
        return scrambled_pair(sobol_reversed(first.index, 2), sobol_reversed(first.index, 3),
                              hash_natural(first.key));
    }
    const Shuffled own = shuffle_samples(s, dimension);
    return scrambled_pair(own.index, sobol_second_reversed(own.index), own.key);
}

#endif
