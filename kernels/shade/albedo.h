// Directional albedos from the tables of shared/albedo.h.
#ifndef ONDE_SHADE_ALBEDO_H
#define ONDE_SHADE_ALBEDO_H

#include "shade/fresnel.h"
#include "shade/scene_view.h"
#include "shared/albedo.h"

// The rows of a table around a roughness.
typedef struct {
    natural table; // its first word
    natural row;
    real fraction; // of the way to the next row
    real alpha;
} AlbedoRow;

INLINE AlbedoRow albedo_row(natural table, real alpha) {
    const real place = sqrt(alpha) * (float)(ALBEDO_ROWS - 1u);
    const real whole = min_real(floor(place), (real)((float)(ALBEDO_ROWS - 2u)));
    AlbedoRow row;
    row.table = table;
    row.row = as_natural(to_integer(whole));
    row.fraction = place - whole;
    row.alpha = alpha;
    return row;
}

INLINE real2 albedo_word(__global const uint* albedos, natural i) {
    const natural word = gather_natural(albedos, i);
    return make2(to_real(word & 0xffffu), to_real(word >> 16u));
}
INLINE real2 mix2(real2 a, real2 b, real t) {
    return make2(fma(b.x - a.x, t, a.x), fma(b.y - a.y, t, a.y));
}
// Two neighbouring words, at a fraction between them.
INLINE real2 albedo_between(__global const uint* albedos, natural i, natural step, real fraction) {
    return mix2(albedo_word(albedos, i), albedo_word(albedos, i + step), fraction);
}

// The numbers of a direction (cosine >= 0), in [0, 1].
INLINE real2 albedo_numbers(__global const uint* albedos, AlbedoRow row, real cosine) {
    const real safe = max_real(cosine, (real)(1e-6f));
    const real place = ALBEDO_PLACE(safe, row.alpha) * (float)(ALBEDO_COLUMNS - 1u);
    const real whole = min_real(floor(place), (real)((float)(ALBEDO_COLUMNS - 2u)));
    const natural first = row.table + row.row * ALBEDO_COLUMNS + as_natural(to_integer(whole));
    const real2 upper = albedo_between(albedos, first, (natural)(1u), place - whole);
    const real2 lower =
        albedo_between(albedos, first + ALBEDO_COLUMNS, (natural)(1u), place - whole);
    const real2 both = mix2(upper, lower, row.fraction);
    return make2(both.x * (1.0f / 65535.0f), both.y * (1.0f / 65535.0f));
}
// Their means.
INLINE real2 albedo_means(__global const uint* albedos, AlbedoRow row) {
    const natural first = row.table + ALBEDO_MEANS + row.row;
    const real2 both = albedo_between(albedos, first, (natural)(1u), row.fraction);
    return make2(both.x * (1.0f / 65535.0f), both.y * (1.0f / 65535.0f));
}

// What microfacets reflect by Schlick's formula: f0 * white + (f90 - f0) * grazing.
typedef struct {
    real white, grazing;
} Albedo;

INLINE Albedo reflection_of_numbers(real2 numbers, real cosine) {
    Albedo a;
    a.white = numbers.x;
    a.grazing = numbers.x * (schlick_weight(cosine) + fma(numbers.y, (real)(2.0f), (real)(-1.0f)));
    return a;
}
INLINE Albedo reflection_albedo(__global const uint* albedos, AlbedoRow row, real cosine) {
    return reflection_of_numbers(albedo_numbers(albedos, row, cosine), cosine);
}
#if ONDE_ANISOTROPY
// A place in a table whose neighbours along an axis are `step` words apart.
typedef struct {
    natural first;
    natural step;
    real fraction;
} GrainAxis;

INLINE GrainAxis grain_axis(real place, uint count, uint step) {
    const real scaled = place * (float)(count - 1u);
    const real whole = min_real(floor(scaled), (real)((float)(count - 2u)));
    GrainAxis axis;
    axis.first = as_natural(to_integer(whole)) * step;
    axis.step = (natural)(step);
    axis.fraction = scaled - whole;
    return axis;
}

// Microfacets with a grain along x. roughness: across it; alpha: along and across.
INLINE Albedo grain_albedo(__global const uint* albedos, natural table, real3 wo, real roughness,
                           real strength, real2 alpha) {
    const real flat2 = fma(wo.x, wo.x, wo.y * wo.y);
    const real flat = 1.0f / sqrt(max_real(flat2, (real)(1e-12f)));
    const real along = min_real(fabs(wo.x) * flat, (real)(1.0f));
    const real x = alpha.x * along, y = alpha.y * wo.y * flat;
    const real seen = sqrt(fma(x, x, y * y)), cosine = max_real(wo.z, (real)(1e-6f));
    GrainAxis axes[4];
    axes[0] = grain_axis(roughness, GRAIN_ROWS, GRAIN_ROWS * GRAIN_COLUMNS * GRAIN_COLUMNS);
    axes[1] = grain_axis(strength, GRAIN_ROWS, GRAIN_COLUMNS * GRAIN_COLUMNS);
    axes[2] = grain_axis(1.0f - sqrt(along), GRAIN_COLUMNS, GRAIN_COLUMNS);
    axes[3] = grain_axis(min_real(ALBEDO_PLACE(cosine, seen), (real)(1.0f)), GRAIN_COLUMNS, 1u);
    real2 sum = make2((real)(0.0f), (real)(0.0f));
    for (uint corner = 0; corner < 16u; corner++) {
        natural word = table;
        real weight = (real)(1.0f / 65535.0f);
        for (uint k = 0; k < 4u; k++) {
            const bool next = corner >> k & 1u;
            word += next ? axes[k].first + axes[k].step : axes[k].first;
            weight *= next ? axes[k].fraction : 1.0f - axes[k].fraction;
        }
        const real2 numbers = albedo_word(albedos, word);
        sum = make2(fma(numbers.x, weight, sum.x), fma(numbers.y, weight, sum.y));
    }
    return reflection_of_numbers(sum, wo.z);
}
#endif

INLINE Albedo mirror_albedo(real cosine) {
    Albedo a;
    a.white = (real)(1.0f);
    a.grazing = schlick_weight(cosine);
    return a;
}
INLINE real schlick_albedo(Albedo a, real f0, real f90) {
    return fma(f90 - f0, a.grazing, f0 * a.white);
}

// What leaves microfacets in all, over what leaves after it has met one of them: of light that is
// lost between them, f0 is not absorbed (Turquin, "Practical multiple scattering compensation for
// microfacet models", 2019).
OVERLOAD real compensation(Albedo a, real f0) {
    return fma(f0, (1.0f - a.white) / a.white, (real)(1.0f));
}
OVERLOAD real3 compensation(Albedo a, real3 f0) {
    return make3(compensation(a, f0.x), compensation(a, f0.y), compensation(a, f0.z));
}

#endif
