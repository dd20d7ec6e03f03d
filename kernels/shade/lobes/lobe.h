// What every lobe of a BSDF gives and takes. Local directions: the shading normal is +z, wo is
// above. A lobe `name` is a file of this folder and a line of LOBES in shared/scene.h:
//   name_load(view, point)              its numbers, from a material's
//   name_weight(lobe, point)            about how much it reflects, for the choice among lobes
//   name_is_smooth(lobe)                whether all of it is a delta part
//   name_eval(lobe, wo, wi, lanes)      BSDF times cosine, and the density of name_sample, both
//                                       without their delta part; nothing in other lanes
//   name_sample(lobe, wo, choice, u)    a direction
#ifndef ONDE_SHADE_LOBES_LOBE_H
#define ONDE_SHADE_LOBES_LOBE_H

#include "math/sampling.h"
#include "shade/albedo.h"
#include "shade/film_interference.h"
#include "shade/texture.h"

// Whether directions are exchanged: light that goes from wo to wi.
#ifndef ONDE_ADJOINT
    #define ONDE_ADJOINT 0
#endif

// A material at a point: what several lobes need of it, textures and all. What one lobe needs it
// reads itself.
typedef struct {
    natural material; // index
    natural kind;     // MATERIAL_...
    UvSets uv;
    real3 color;
    real alpha;    // roughness^2
    mask beckmann; // whether its microfacets are distributed as Beckmann's
#if ONDE_INNER
    mask plastic; // its coat is passed on the way in as well
    real exact;   // how far a smooth plastic's coat reflects by Fresnel's equations; that of rough
                  // ones by Schlick's formula, of which the tables of albedos are
    real ior;
#endif
#if ONDE_ANISOTROPY
    real roughness, anisotropy;
    real2 grain; // alphas along the grain and across
#endif
    real metallic;
    real3 f0; // reflectance of the dielectric half at normal incidence
    real f90; // and at grazing
#if ONDE_TRANSMISSION
    real transmission; // the share of the dielectric half's body that is clear
#endif
    real behind; // the share of what is left that scatters light to the far side
    real3 behind_color;
    real clearcoat, coat_alpha;
    real3 coat_normal; // in local directions
    real3 sheen_color;
    real sheen_alpha;
#if ONDE_IRIDESCENCE
    real iridescence;
    Film film;
#endif
#if ONDE_DISPERSION
    real bend; // of the light's wavelength, as of SpectrumKnot
#endif
    mask front;    // whether its front is seen
    real3 wo;      // view direction
    real cosine;   // of it and the shading normal, > 0
    Albedo albedo; // of its microfacets, along wo
} MaterialPoint;

// Whether it is of a kind; the answer is known where no material of the scene is.
INLINE mask is_of_kind(MaterialPoint m, uint kind) {
    return ONDE_KINDS >> kind & 1u ? m.kind == kind : m.kind != m.kind;
}

// Whether it has the glossy lobe.
INLINE mask is_glossy(MaterialPoint m) {
    return is_of_kind(m, MATERIAL_METALLIC_ROUGHNESS) | is_of_kind(m, MATERIAL_CONDUCTOR);
}

// The first word of the table of what its microfacets reflect.
INLINE natural reflection_table(MaterialPoint m) {
#if ONDE_BECKMANN
    return choose(m.beckmann, (natural)(BECKMANN_TABLE), (natural)(0u));
#else
    return (natural)(0u);
#endif
}

// What microfacets reflect of light along a local direction; a mirror's in other lanes.
INLINE Albedo microfacet_albedo(SceneView view, MaterialPoint m, real3 w, mask lanes) {
    const real cosine = fabs(w.z);
    Albedo a = mirror_albedo(cosine);
    const mask rough = lanes & (m.alpha >= SMOOTH_ALPHA);
    if (!ONDE_ALBEDOS) return a;
    if_any (rough) {
        const AlbedoRow row = albedo_row(reflection_table(m), m.alpha);
        const Albedo found = reflection_albedo(view.albedos, row, cosine);
        a.white = choose(rough, found.white, a.white);
        a.grazing = choose(rough, found.grazing, a.grazing);
    }
#if ONDE_ANISOTROPY
    const mask grained = is_glossy(m) & (m.anisotropy > 0.0f);
    if_any (grained) {
        natural table = (natural)(GRAIN_TABLE);
    #if ONDE_BECKMANN
        table = choose(m.beckmann, (natural)(BECKMANN_GRAIN_TABLE), table);
    #endif
        const Albedo found = grain_albedo(view.albedos, table, make3(w.x, w.y, cosine), m.roughness,
                                          m.anisotropy, m.grain);
        a.white = choose(grained, found.white, a.white);
        a.grazing = choose(grained, found.grazing, a.grazing);
    }
#endif
    return a;
}

// The share of a surface that has a clear body.
INLINE real clear_share(MaterialPoint m) {
#if ONDE_TRANSMISSION
    const mask mixed = is_of_kind(m, MATERIAL_METALLIC_ROUGHNESS);
    return choose(mixed, m.transmission * (1.0f - m.metallic), (real)(1.0f));
#else
    return (real)(1.0f);
#endif
}
// Reflectance at normal incidence of a boundary to index 1.5, with the bits of the general formula.
#define DIELECTRIC_F0 (0.2f * 0.2f)

// Of a mix of dielectric and metal the part that is dielectric, but not clear.
INLINE real opaque_share(MaterialPoint m, real metallic) {
#if ONDE_TRANSMISSION
    return (1.0f - metallic) * (1.0f - m.transmission);
#else
    return 1.0f - metallic;
#endif
}

// BSDF times cosine is the product of tint and value; the sum of lobes rounds once.
typedef struct {
    real3 tint, value;
    real pdf;
} LobeValue;

typedef struct {
    real3 wi;
    mask delta;   // wi is the only direction
    real3 weight; // of that direction: BSDF times cosine over pdf
    mask valid;   // wi lies on the side that it should
} LobeSample;

OVERLOAD LobeSample choose(mask m, LobeSample a, LobeSample b) {
    LobeSample s;
    s.wi = choose(m, a.wi, b.wi);
    s.delta = choose(m, a.delta, b.delta);
    s.weight = choose(m, a.weight, b.weight);
    s.valid = choose(m, a.valid, b.valid);
    return s;
}

INLINE LobeValue no_lobe_value(void) {
    LobeValue v;
    v.tint = v.value = zero3();
    v.pdf = (real)(0.0f);
    return v;
}

// A direction that is as likely as its cosine.
INLINE LobeSample cosine_lobe_sample(real2 u) {
    LobeSample s;
    s.wi = sample_cosine_hemisphere(u);
    s.valid = s.wi.z > 0.0f;
    s.delta = s.valid & !s.valid;
    s.weight = zero3();
    return s;
}

#endif
