// Probes of the BSDFs of a scene's materials, by local directions.
#include "probe/scene_probe.h"
#include "shade/material.h"

#define BSDF_WORDS 6

// Material, front or not, bend of the wavelength, wo (3).
INLINE Bsdf input_bsdf(SceneView view, Items items) {
    Surface s;
    s.material = input_natural(items, 0);
    s.front = input_mask(items, 1);
    s.uv = same_in_all_sets(make2((real)(0.0f), (real)(0.0f)));
    s.tint = splat3((real)(1.0f));
    const Basis basis = make_basis(make3((real)(0.0f), (real)(0.0f), (real)(1.0f)));
#if ONDE_NORMAL_MAPS
    s.coat_normal = basis.n;
#endif
#if ONDE_DISPERSION
    s.bend = input(items, 2);
#endif
    return material_bsdf(view, s, basis, input3(items, BSDF_WORDS - 3));
}

// In: BSDF, wi (3). Out: value times cosine (3), pdf.
SCENE_PROBE(bsdf_eval) {
    const BsdfValue v = bsdf_eval(input_bsdf(view, items), input3(items, BSDF_WORDS - 3),
                                  input3(items, BSDF_WORDS));
    output(items, 0, v.value);
    output(items, 3, v.pdf);
}

// In: BSDF, choice, u (2). Out: wi (3), weight (3), pdf, delta, valid.
SCENE_PROBE(bsdf_sample) {
    const BsdfSample s = bsdf_sample(input_bsdf(view, items), input3(items, BSDF_WORDS - 3),
                                     input(items, BSDF_WORDS), input2(items, BSDF_WORDS + 1));
    output(items, 0, s.wi);
    output(items, 3, s.weight);
    output(items, 6, s.pdf);
    output_mask(items, 7, s.delta);
    output_mask(items, 8, s.valid);
}

// In: BSDF. Out: the probability of each lobe, then whether each is there.
SCENE_PROBE(bsdf_lobes) {
    const Bsdf b = input_bsdf(view, items);
#define OUTPUT_LOBE(NAME, name, Type, transmits)                                                   \
    output(items, LOBE_##NAME, HAS_LOBE(NAME) ? b.probability.name : (real)(0.0f));                \
    output_mask(items, LOBE_COUNT + LOBE_##NAME, HAS_LOBE(NAME) ? b.has.name : (mask)(0));
    LOBES(OUTPUT_LOBE)
}
