// Glass that bends light of each wavelength its own way. A path has all of them until such glass
// bends it; from there on it has the one that it drew, in that one's colour.
#ifndef ONDE_SHADE_DISPERSION_H
#define ONDE_SHADE_DISPERSION_H

#include "math/random.h"
#include "shade/scene_view.h"

#if ONDE_DISPERSION
typedef struct {
    real bend; // as of SpectrumKnot
    real3 color;
} Wave;

// The wavelength that a path draws, where a surface needs one.
INLINE Wave path_wave(SceneView view, Sampler sampler, natural material, mask lanes) {
    Wave wave;
    wave.bend = (real)(0.0f);
    wave.color = splat3((real)(1.0f));
    const real dispersion = RECORD(view.materials, material, MaterialRecord, dispersion);
    if (!mask_bits(lanes & (dispersion > 0.0f))) return wave;
    const real u = sampler_pair(sampler, DIMENSION_WAVELENGTH).x;
    const real place = u * (float)(SPECTRUM_KNOTS - 1u);
    const real whole = min_real(floor(place), (real)((float)(SPECTRUM_KNOTS - 2u)));
    const natural i = as_natural(to_integer(whole)), next = i + 1u;
    const real t = place - whole;
    const real first = RECORD(view.spectrum, i, SpectrumKnot, bend);
    wave.bend = fma(RECORD(view.spectrum, next, SpectrumKnot, bend) - first, t, first);
    wave.color = mix3(RECORD3(view.spectrum, i, SpectrumKnot, color),
                      RECORD3(view.spectrum, next, SpectrumKnot, color), t);
    return wave;
}
#endif

#endif
