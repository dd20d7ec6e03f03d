// A vertex of a path on a surface: its geometry and BSDF, where rays leave it, and on which side
// they may. Shared by the estimators that follow BSDFs.
#ifndef ONDE_SHADE_VERTEX_H
#define ONDE_SHADE_VERTEX_H

#include "shade/dispersion.h"
#include "shade/lights/light_type.h"
#include "shade/shading_normal.h"

// The geometry of a vertex, shared by what happens there.
typedef struct {
    Surface surface;
    Basis basis;
    real3 wo; // local, above
    real t;   // of the ray that came here
    Bsdf bsdf;
#if ONDE_DISPERSION
    Wave wave;
#endif
} Vertex;

#if ONDE_DISPERSION
// What of light goes on along local direction wi: all, or that of the wave.
INLINE real3 wave_share(Vertex v, real3 wi, natural dispersed) {
    const mask turned = bsdf_disperses(v.bsdf, wi) & (dispersed == 0u);
    return choose(turned, v.wave.color, splat3((real)(1.0f)));
}
INLINE natural dispersed_along(Vertex v, real3 wi, natural dispersed) {
    return choose(bsdf_disperses(v.bsdf, wi), (natural)(1u), dispersed);
}
#endif

// The vertex as one that lights light.
INLINE Receiver vertex_receiver(Vertex v) {
    const real3 normal = choose(bsdf_transmits(v.bsdf), zero3(), v.surface.normal);
    return receiver_at(v.surface.position, normal);
}

// Where a ray leaves the vertex in world direction d.
INLINE real3 vertex_exit(Vertex v, real3 d) {
    const real3 side = choose(dot3(d, v.surface.geometric) > 0.0f, v.surface.geometric,
                              negate3(v.surface.geometric));
    real3 exit = offset_origin(v.surface.position, side, v.surface.lift);
#if ONDE_CURVED
    exit = choose(leaves_curve(v.surface, d), curve_exit(v.surface), exit);
#endif
    return exit;
}

// Opaque surfaces let no light through, whatever their shading normals say; glass must have
// reflection and refraction on the true sides too.
INLINE mask true_side(Vertex v, real3 wi, real3 world) {
    const real outward = dot3(world, v.surface.geometric);
    mask above = outward > 0.0f;
#if ONDE_CURVED
    above = above | leaves_curve(v.surface, world);
#endif
    return choose(wi.z > 0.0f, above, (outward < 0.0f) & bsdf_transmits(v.bsdf));
}

// Russian roulette: the probability with which a path of this throughput goes on. What carries a
// quarter or more is not worth ending: later vertices share the work of the earlier ones.
INLINE real roulette_survival(real3 throughput) {
    return clamp_real(4.0f * max_component3(throughput), 0.05f, 1.0f);
}

#endif
