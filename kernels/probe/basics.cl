// Probes of lanes, mathematics, random numbers, sampling and Fresnel terms, which need no scene.
#include "math/random.h"
#include "math/sampling.h"
#include "probe/probe.h"
#include "shade/fresnel.h"
#include "shade/phase.h"

// In: value, condition, index into the values. Out: the group's bits; the condition from them;
// whether any lane's holds; the value at the index.
PROBE(lanes) {
    const mask condition = input_mask(items, 1);
    const uint bits = mask_bits(condition);
    real ran = (real)(0.0f);
    if_any (condition) ran = (real)(1.0f);
    output(items, 0, (natural)(bits));
    output_mask(items, 1, mask_from_bits(bits));
    output(items, 2, ran);
    output(items, 3, gather_real(items.in, input_natural(items, 2)));
}

// In: value, condition. Out: the values whose condition holds, at the start of their group.
PROBE(compress) {
    compress_real(items.out + items.first, input(items, 0), mask_bits(input_mask(items, 1)));
}

// In: turns; y, x; octahedral word. Out: sine, cosine; angle; vector.
PROBE(math) {
    const SineCosine a = sincos_turns(input(items, 0));
    output(items, 0, a.sine);
    output(items, 1, a.cosine);
    output(items, 2, angle_turns(input(items, 1), input(items, 2)));
    output(items, 3, decode_octahedral(input_natural(items, 3)));
}

// In: x > 0; exponent; 1 - base in [0, 1], power. Out: log2 of x, 2 to the exponent, base to the
// power.
PROBE(powers) {
    output(items, 0, log2_real(input(items, 0)));
    output(items, 1, exp2_real(input(items, 1)));
    output(items, 2, power_below_one(input(items, 2), input(items, 3)));
}

// In: unit vector n, vector v. Out: the basis around n, v in it, and v back from it.
PROBE(basis) {
    const Basis basis = make_basis(input3(items, 0));
    const real3 inside = to_local(basis, input3(items, 3));
    output(items, 0, basis.s);
    output(items, 3, basis.t);
    output(items, 6, basis.n);
    output(items, 9, inside);
    output(items, 12, to_world(basis, inside));
}

// In: pixel, sample, and for all items one dimension and one seed. Out: the pair.
PROBE(random) {
    const Sampler sampler =
        sampler_start(input_natural(items, 0), input_natural(items, 1), input_uniform(items, 3));
    output(items, 0, sampler_pair(sampler, input_uniform(items, 2)));
}

// In: u (2), opening of the cone. Out: points on the disk, cosine hemisphere, cone, sphere and
// triangle; densities of the cosine hemisphere and of the cone.
PROBE(sampling) {
    const real2 u = input2(items, 0);
    const real opening = input(items, 2);
    const real3 cosine = sample_cosine_hemisphere(u);
    output(items, 0, sample_disk(u));
    output(items, 2, cosine);
    output(items, 5, sample_cone(u, opening));
    output(items, 8, sample_sphere(u));
    output(items, 11, sample_triangle(u));
    output(items, 13, pdf_cosine_hemisphere(cosine.z));
    output(items, 14, pdf_cone(opening));
}

// In: two densities. Out: the weight of the first.
PROBE(heuristic) {
    output(items, 0, power_heuristic(input(items, 0), input(items, 1)));
}

// In: cosine, relative index, f0 (3), f90. Out: dielectric and Schlick's reflectance (3).
PROBE(fresnel) {
    output(items, 0, fresnel_dielectric(input(items, 0), input(items, 1)));
    output(items, 1, fresnel_schlick(input3(items, 2), splat3(input(items, 5)), input(items, 0)));
}

// In: direction on (3), anisotropy, u (2). Out: direction, its density.
PROBE(phase) {
    const real3 on = input3(items, 0);
    const real3 to = phase_sample(on, input(items, 3), input2(items, 4));
    output(items, 0, to);
    output(items, 3, phase_value(dot3(on, to), input(items, 3)));
}
