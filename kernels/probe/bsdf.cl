// Probes of the BSDF, from its numbers and local directions.
#include "probe/probe.h"
#include "shade/bsdf.h"

#define BSDF_WORDS 11

// Diffuse albedo or tint of glass (3), f0 (3), f90, alpha, probability of the glossy lobe, eta,
// dielectric or not.
INLINE Bsdf input_bsdf(Items items) {
    Bsdf b;
    b.has.dielectric = input_mask(items, 10);
    b.has.diffuse = b.has.glossy = !b.has.dielectric;
    b.glossy.f0 = input3(items, 3);
    b.glossy.f90 = input(items, 6);
    b.glossy.alpha = input(items, 7);
    b.diffuse.albedo = input3(items, 0);
    b.diffuse.coat = b.glossy.f90;
    b.dielectric.tint = input3(items, 0);
    b.dielectric.alpha = input(items, 7);
    b.dielectric.eta = input(items, 9);
    const real zero = (real)(0.0f), one = (real)(1.0f), glossy = input(items, 8);
    b.probability.dielectric = choose(b.has.dielectric, one, zero);
    b.probability.glossy = choose(b.has.dielectric, zero, glossy);
    b.probability.diffuse = choose(b.has.dielectric, zero, 1.0f - glossy);
    b.reach.dielectric = b.probability.dielectric;
    b.reach.glossy = choose(b.has.dielectric, one, glossy);
    b.reach.diffuse = one;
    return b;
}

// In: BSDF, wo (3), wi (3). Out: value times cosine (3), pdf.
PROBE(bsdf_eval) {
    const BsdfValue v =
        bsdf_eval(input_bsdf(items), input3(items, BSDF_WORDS), input3(items, BSDF_WORDS + 3));
    output(items, 0, v.value);
    output(items, 3, v.pdf);
}

// In: BSDF, wo (3), choice, u (2). Out: wi (3), weight (3), pdf, delta, valid.
PROBE(bsdf_sample) {
    const BsdfSample s = bsdf_sample(input_bsdf(items), input3(items, BSDF_WORDS),
                                     input(items, BSDF_WORDS + 3), input2(items, BSDF_WORDS + 4));
    output(items, 0, s.wi);
    output(items, 3, s.weight);
    output(items, 6, s.pdf);
    output_mask(items, 7, s.delta);
    output_mask(items, 8, s.valid);
}
