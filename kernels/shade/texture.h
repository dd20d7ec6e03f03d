// Lookups in textures of 8 bits, 16 bits or floats, bilinear or of the nearest texel. NO_INDEX
// stands for a texture of ones.
#ifndef ONDE_SHADE_TEXTURE_H
#define ONDE_SHADE_TEXTURE_H

#include "math/elementary.h"
#include "shade/scene_view.h"

// The texture coordinates of a point, a pair for each set that some texture of the scene uses.
typedef struct {
    real2 set[ONDE_UV_SETS];
#if ONDE_MIP_TEXTURES
    real width; // of what is seen of the first set; 0: all details are looked up
#endif
} UvSets;

INLINE UvSets same_in_all_sets(real2 uv) {
    UvSets uvs;
    for (uint k = 0; k < ONDE_UV_SETS; k++) uvs.set[k] = uv;
#if ONDE_MIP_TEXTURES
    uvs.width = (real)(0.0f);
#endif
    return uvs;
}

// A texture's own coordinates of the point.
INLINE real2 texture_uv(SceneView view, natural texture, UvSets uvs) {
    real2 uv = uvs.set[0];
#if ONDE_UV_SETS > 1
    const natural set = RECORD_NATURAL(view.textures, texture, TextureRecord, uv_set);
    for (uint k = 1; k < ONDE_UV_SETS; k++) uv = choose(set == k, uvs.set[k], uv);
#endif
#if ONDE_TEXTURE_TRANSFORMS
    const real3 to_u = RECORD3(view.textures, texture, TextureRecord, u);
    const real3 to_v = RECORD3(view.textures, texture, TextureRecord, v);
    uv = make2(fma(to_u.x, uv.x, fma(to_u.y, uv.y, to_u.z)),
               fma(to_v.x, uv.x, fma(to_v.y, uv.y, to_v.z)));
#endif
    return uv;
}

// The two texel coordinates around a texture coordinate, and the weight of the second.
typedef struct {
    natural first, second;
    real fraction;
} TexelPair;

INLINE TexelPair texel_pair(real t, natural size, natural wrap, natural filter) {
    const mask repeat = wrap == WRAP_REPEAT, mirror = wrap == WRAP_MIRROR;
    const real folded = t - 2.0f * floor(t * 0.5f); // in [0, 2]
    t = choose(repeat, t - floor(t),
               choose(mirror, choose(folded > 1.0f, 2.0f - folded, folded), t));
    const integer n = as_integer(size);
    real x = fma(clamp_real(t, 0.0f, 1.0f), to_real(n), (real)(-0.5f));
#if ONDE_NEAREST_FILTERS // then both are the texel that the coordinate lies in
    x = choose(filter == FILTER_NEAREST, min_real(floor(x + 0.5f), to_real(n - 1)), x);
#endif
    const real below = floor(x);
    const integer i = to_integer(below);
    const integer last = n - 1;
    const integer low = choose(i < 0, choose(repeat, last, (integer)(0)), i);
    const integer high = choose(i >= last, choose(repeat, (integer)(0), last), i + 1);
    TexelPair pair;
    pair.first = as_natural(low);
    pair.second = as_natural(high);
    pair.fraction = x - below;
    return pair;
}

// A word of a picture's texels.
#if ONDE_SPLIT_TEXELS
INLINE natural word_of_buffer(__global const uint* texels, mask here, natural index, natural word) {
    if (!mask_bits(here)) return word;
    return choose(here, gather_natural(texels, choose(here, index, (natural)(0u))), word);
}
INLINE natural texel_word(SceneView view, natural buffer, natural index) {
    natural word = word_of_buffer(view.texels, buffer == 0u, index, (natural)(0u));
    word = word_of_buffer(view.texels1, buffer == 1u, index, word);
    word = word_of_buffer(view.texels2, buffer == 2u, index, word);
    return word_of_buffer(view.texels3, buffer == 3u, index, word);
}
#else
INLINE natural texel_word(SceneView view, natural buffer, natural index) {
    return gather_natural(view.texels, index);
}
#endif

// Where a picture's texels lie, and how; see TextureRecord.
typedef struct {
    natural offset, buffer, format;
} TexelPlace;

INLINE TexelPlace texel_place(SceneView view, natural texture) {
    TexelPlace place;
    place.offset = RECORD_NATURAL(view.textures, texture, TextureRecord, offset);
    place.buffer = place.format = (natural)(0u);
#if ONDE_WIDE_TEXTURES
    place.format = RECORD_NATURAL(view.textures, texture, TextureRecord, format);
#endif
#if ONDE_SPLIT_TEXELS
    place.buffer = RECORD_NATURAL(view.textures, texture, TextureRecord, buffer);
#endif
    return place;
}

#if ONDE_FLOAT_TEXTURES
    #define TEXEL_WORDS 4u
#elif ONDE_WIDE_TEXTURES
    #define TEXEL_WORDS 2u
#else
    #define TEXEL_WORDS 1u
#endif

// Those words that a texel has not are its last one: 257 times a byte is that byte twice.
typedef struct {
    natural word[TEXEL_WORDS];
#if ONDE_FLOAT_TEXTURES
    natural format;
#endif
} Texel;

INLINE Texel fetch_texel(SceneView view, TexelPlace place, natural index) {
    Texel texel;
#if ONDE_WIDE_TEXTURES
    const natural several = choose(place.format == TEXEL_FLOATS, (natural)(3u), (natural)(1u));
    const natural last = choose(place.format == TEXEL_BYTES, (natural)(0u), several);
    const natural first = place.offset + index * (last + 1u);
    for (uint k = 0; k < TEXEL_WORDS; k++)
        texel.word[k] =
            texel_word(view, place.buffer, first + choose(last < k, last, (natural)(k)));
#else
    texel.word[0] = texel_word(view, place.buffer, place.offset + index);
#endif
#if ONDE_FLOAT_TEXTURES
    texel.format = place.format;
#endif
    return texel;
}

INLINE natural texel_byte(natural word, uint k) {
    return (word >> (8 * k)) & 255u;
}

#if ONDE_WIDE_TEXTURES
// What the lower byte of channel k adds to the higher one, in units of the latter; 0 where both are
// equal, as they are in a texture of 8 bits.
INLINE real texel_rest(Texel texel, uint k) {
    const natural high = texel_byte(texel.word[0], k), low = texel_byte(texel.word[1], k);
    return to_real(as_integer(low) - as_integer(high)) * (1.0f / 257.0f);
}
#endif

#if ONDE_FLOAT_TEXTURES
// Channel k of halves or floats where the texel has those, else `code`.
INLINE real texel_number(Texel texel, uint k, real code) {
    const real of_half = from_half((texel.word[k >> 1] >> (16 * (k & 1u))) & 0xffffu);
    const real number = choose(texel.format == TEXEL_HALVES, of_half, as_real(texel.word[k]));
    return choose(texel.format >= TEXEL_HALVES, number, code);
}
#endif

// Channel k, 3 is alpha, in 0 to 1.
INLINE real texel_channel(Texel texel, uint k) {
    const real high = to_real(texel_byte(texel.word[0], k));
#if ONDE_FLOAT_TEXTURES
    const real code = (high + texel_rest(texel, k)) * (1.0f / 255.0f);
    return min_real(texel_number(texel, k, code), (real)(1.0f));
#elif ONDE_WIDE_TEXTURES
    return (high + texel_rest(texel, k)) * (1.0f / 255.0f);
#else
    return high * (1.0f / 255.0f);
#endif
}

// The linear value of a channel whose codes are sRGB.
INLINE real texel_decoded(SceneView view, Texel texel, uint k) {
    const natural code = texel_byte(texel.word[0], k);
    const real linear = gather_real(view.srgb, code);
#if ONDE_WIDE_TEXTURES // on the line to the next code, which is within 6e-6 of the curve
    const real rest = texel_rest(texel, k);
    const natural next = choose(rest < 0.0f, code - 1u, code + 1u);
    const real other = gather_real(view.srgb, choose(rest == 0.0f, code, next));
    return fma(fabs(rest), other - linear, linear);
#else
    return linear;
#endif
}

// Channel k of a colour, linear. Floats are as they are.
INLINE real texel_linear(SceneView view, Texel texel, uint k) {
    const real decoded = texel_decoded(view, texel, k);
#if ONDE_FLOAT_TEXTURES
    return texel_number(texel, k, decoded);
#else
    return decoded;
#endif
}

INLINE real3 texel_data(Texel texel) {
    return make3(texel_channel(texel, 0), texel_channel(texel, 1), texel_channel(texel, 2));
}
INLINE real3 texel_color(SceneView view, Texel texel) {
    return make3(texel_linear(view, texel, 0), texel_linear(view, texel, 1),
                 texel_linear(view, texel, 2));
}

typedef struct {
    Texel texel[4]; // (0,0) (1,0) (0,1) (1,1)
    real x, y;
} TexelQuad;

INLINE TexelQuad fetch_quad(SceneView view, natural texture, UvSets uvs) {
    const real2 uv = texture_uv(view, texture, uvs);
    const natural width = RECORD_NATURAL(view.textures, texture, TextureRecord, width);
    const natural height = RECORD_NATURAL(view.textures, texture, TextureRecord, height);
    const TexelPlace place = texel_place(view, texture);
    const natural wrap_u = RECORD_NATURAL(view.textures, texture, TextureRecord, wrap_u);
    const natural wrap_v = RECORD_NATURAL(view.textures, texture, TextureRecord, wrap_v);
    natural filter = (natural)(FILTER_LINEAR);
#if ONDE_NEAREST_FILTERS
    filter = RECORD_NATURAL(view.textures, texture, TextureRecord, filter);
#endif
    const TexelPair x = texel_pair(uv.x, width, wrap_u, filter);
    const TexelPair y = texel_pair(uv.y, height, wrap_v, filter);
    const natural row0 = y.first * width, row1 = y.second * width;
    TexelQuad quad;
    quad.texel[0] = fetch_texel(view, place, row0 + x.first);
    quad.texel[1] = fetch_texel(view, place, row0 + x.second);
    quad.texel[2] = fetch_texel(view, place, row1 + x.first);
    quad.texel[3] = fetch_texel(view, place, row1 + x.second);
    quad.x = x.fraction;
    quad.y = y.fraction;
    return quad;
}

#if ONDE_MIP_TEXTURES
// The exponent of the power of two at or below a number from 1 on.
INLINE integer exponent_of(real a) {
    return (as_integer(a) >> 23) - 127;
}

// The level of a texture whose texels are between a third and 0.71 as wide as what is seen. Samples
// do the rest: of wider ones the picture's error is larger at many samples, for their blur.
INLINE natural texture_level(SceneView view, natural texture, UvSets uvs) {
    const natural width = RECORD_NATURAL(view.textures, texture, TextureRecord, width);
    const natural height = RECORD_NATURAL(view.textures, texture, TextureRecord, height);
    const natural coarser = RECORD_NATURAL(view.textures, texture, TextureRecord, coarser);
    const real columns = to_real(as_integer(width)), rows = to_real(as_integer(height));
    real seen = 0.70710678f * uvs.width * min_real(columns, rows);
    #if ONDE_TEXTURE_TRANSFORMS
    const real3 to_u = RECORD3(view.textures, texture, TextureRecord, u);
    const real3 to_v = RECORD3(view.textures, texture, TextureRecord, v);
    seen *= safe_sqrt(
        min_real(fma(to_u.x, to_u.x, to_v.x * to_v.x), fma(to_u.y, to_u.y, to_v.y * to_v.y)));
    #endif
    mask filtered = (coarser != NO_INDEX) & (seen >= 2.0f);
    #if ONDE_UV_SETS > 1
    filtered = filtered & (RECORD_NATURAL(view.textures, texture, TextureRecord, uv_set) == 0u);
    #endif
    const integer last = exponent_of(max_real(columns, rows)), level = exponent_of(seen);
    const natural below = as_natural(choose(level < last, level, last)) - 1u;
    return choose(filtered, coarser + below, texture);
}
#else
INLINE natural texture_level(SceneView view, natural texture, UvSets uvs) {
    return texture;
}
#endif

// The texture of a material's slot, TEXTURE_...; NO_INDEX where it has none.
INLINE natural material_texture(SceneView view, natural material, uint slot) {
    return gather_natural((__global const uint*)view.materials,
                          material * (uint)(sizeof(MaterialRecord) / 4) +
                              (uint)(__builtin_offsetof(MaterialRecord, texture) / 4) + slot);
}

// Linear values of a texture that stores data (normals, roughness), 1 at most.
INLINE real3 texture_data(SceneView view, natural texture, UvSets uvs) {
    const mask present = texture != NO_INDEX;
    const real3 ones = splat3((real)(1.0f));
    if (!mask_bits(present)) return ones;
    const TexelQuad q = fetch_quad(view, choose(present, texture, (natural)(0u)), uvs);
    const real3 top = mix3(texel_data(q.texel[0]), texel_data(q.texel[1]), q.x);
    const real3 bottom = mix3(texel_data(q.texel[2]), texel_data(q.texel[3]), q.x);
    return choose(present, mix3(top, bottom, q.y), ones);
}

// Linear values of a texture that stores colours; texels are linearised before filtering. Coarser
// levels are for colours only: light is linear in them, but not in normals, roughness and opacity.
INLINE real3 texture_color(SceneView view, natural texture, UvSets uvs) {
    const mask present = texture != NO_INDEX;
    const real3 ones = splat3((real)(1.0f));
    if (!mask_bits(present)) return ones;
    const natural there = choose(present, texture, (natural)(0u));
    const TexelQuad q = fetch_quad(view, texture_level(view, there, uvs), uvs);
    const real3 top = mix3(texel_color(view, q.texel[0]), texel_color(view, q.texel[1]), q.x);
    const real3 bottom = mix3(texel_color(view, q.texel[2]), texel_color(view, q.texel[3]), q.x);
    return choose(present, mix3(top, bottom, q.y), ones);
}

INLINE real3 at_most_one(real3 c) {
    const real one = (real)(1.0f);
    return make3(min_real(c.x, one), min_real(c.y, one), min_real(c.z, one));
}
// The same of what reflects or transmits, 1 at most.
INLINE real3 texture_tint(SceneView view, natural texture, UvSets uvs) {
    const real3 color = texture_color(view, texture, uvs);
#if ONDE_FLOAT_TEXTURES
    return at_most_one(color);
#else
    return color;
#endif
}

// The alpha of a texture.
INLINE real texture_alpha(SceneView view, natural texture, UvSets uvs) {
    const mask present = texture != NO_INDEX;
    const real one = (real)(1.0f);
    if (!mask_bits(present)) return one;
    const TexelQuad q = fetch_quad(view, choose(present, texture, (natural)(0u)), uvs);
    real alpha[4];
    for (uint k = 0; k < 4; k++) alpha[k] = texel_channel(q.texel[k], 3);
    const real top = fma(alpha[1] - alpha[0], q.x, alpha[0]);
    const real bottom = fma(alpha[3] - alpha[2], q.x, alpha[2]);
    return choose(present, fma(bottom - top, q.y, top), one);
}

#endif
