// What light meets between surfaces. A path knows the medium that it is in and the one around that;
// solids in solids in solids are more than it can tell.
//
// How a connection goes is one word: WAY_UNBENT where smooth solids let it pass, as no other way
// finds its light; and the media that it starts in.
#ifndef ONDE_SHADE_MEDIA_H
#define ONDE_SHADE_MEDIA_H

#include "shade/grid.h"
#include "shade/phase.h"

#define WAY_UNBENT 0x80000000u
#define MEDIA_BITS 15u

#if ONDE_MEDIA

// The medium that one is in.
INLINE natural medium_within(natural media) {
    return media & MOST_MEDIA;
}

// The media beyond the surface of a material, its front on this side or not.
INLINE natural media_beyond(SceneView view, natural media, natural material, mask front) {
    const natural inside = RECORD_NATURAL(view.materials, material, MaterialRecord, medium);
    const natural own = media & MOST_MEDIA, around = media >> MEDIA_BITS & MOST_MEDIA;
    const natural entered = own << MEDIA_BITS | inside;
    const natural left =
        choose(own == inside, around, choose(around == inside, own, (natural)(MEDIUM_AROUND)));
    return choose(inside == NO_INDEX, media, choose(front, entered, left));
}

INLINE real3 medium_extinction(SceneView view, natural medium) {
    return RECORD3(view.media, medium, MediumRecord, extinction);
}

// What is left after a distance.
INLINE real3 transmittance_of(real3 extinction, real distance) {
    const real nepers = -1.44269504f * min_real(distance, (real)(1e30f));
    return make3(exp2_real(extinction.x * nepers), exp2_real(extinction.y * nepers),
                 exp2_real(extinction.z * nepers));
}

// What a ray meets before `distance`, if anything: `at` there, where light has the weight of what
// is scattered; else the weight of what comes through.
typedef struct {
    mask scattered;
    real at;
    real3 weight;
    #if ONDE_GLOW
    real3 glow; // radiance that the medium adds on the way
    #endif
} MediumEvent;

INLINE MediumEvent no_event(real distance, mask lanes) {
    MediumEvent event;
    event.scattered = lanes & !lanes;
    event.at = distance;
    event.weight = splat3((real)(1.0f));
    #if ONDE_GLOW
    event.glow = zero3();
    #endif
    return event;
}

    #if ONDE_GLOW
// The mean of what is left, by channel, over a distance: (1 - exp(-x)) / x.
INLINE real mean_left(real extinction, real distance) {
    const real x = extinction * distance;
    const real few = fma(x, fma(x, (real)(1.0f / 6.0f), (real)(-0.5f)), (real)(1.0f));
    const real many = (1.0f - exp2_real(-1.44269504f * x)) / max_real(x, (real)(1e-3f));
    return choose(x < 0.03f, few, many);
}

// What a medium adds that is the same everywhere. Nothing comes from as far as there is no end.
INLINE real3 even_glow(SceneView view, natural medium, real3 extinction, real distance) {
    const real length = min_real(distance, (real)(1e15f));
    const real3 mean = make3(mean_left(extinction.x, length), mean_left(extinction.y, length),
                             mean_left(extinction.z, length));
    const real3 emission = RECORD3(view.media, medium, MediumRecord, emission);
    const real3 all = mul3(emission, scale3(mean, length));
    const mask ends = distance < INFINITE_DISTANCE;
    return make3(choose(ends | (extinction.x > 0.0f), all.x, (real)(0.0f)),
                 choose(ends | (extinction.y > 0.0f), all.y, (real)(0.0f)),
                 choose(ends | (extinction.z > 0.0f), all.z, (real)(0.0f)));
}
    #endif

// What light has by channel, as shares.
INLINE real3 shares_of(real3 carried) {
    const real all = carried.x + carried.y + carried.z;
    return scale3(carried, 1.0f / max_real(all, (real)(1e-30f)));
}

// The rate of the channel that u picks in proportion to the shares.
INLINE real drawn_rate(real3 extinction, real3 share, real u) {
    return choose(u < share.x, extinction.x,
                  choose(u < share.x + share.y, extinction.y, extinction.z));
}

// carried: what light has by channel. In proportion to it u.x picks the channel by whose extinction
// u.y draws the distance, of which the density is the mean over the channels.
INLINE MediumEvent medium_event(SceneView view, natural medium, real distance, real3 carried,
                                real2 u, mask lanes) {
    MediumEvent event = no_event(distance, lanes);
    const real3 extinction = medium_extinction(view, medium);
    #if ONDE_GLOW
    event.glow = choose(lanes, even_glow(view, medium, extinction, distance), zero3());
    #endif
    const mask dense = lanes & nonzero3(extinction);
    if (!mask_bits(dense)) return event;
    const real3 scattering = RECORD3(view.media, medium, MediumRecord, scattering);
    const real3 share = shares_of(carried);
    const real drawn = drawn_rate(extinction, share, u.x);
    const real depth = -0.69314718f * log2_real(max_real(1.0f - u.y, (real)(1e-8f)));
    const real at = choose(drawn > 0.0f, depth / max_real(drawn, (real)(1e-30f)), (real)(1e30f));
    event.scattered = dense & nonzero3(scattering) & (at < distance);
    event.at = choose(event.scattered, at, distance);
    const real3 left = transmittance_of(extinction, event.at);
    const real density = dot3(share, mul3(extinction, left));
    const real3 scattered =
        scale3(mul3(scattering, left), 1.0f / max_real(density, (real)(1e-30f)));
    // Where nothing scatters, nothing is drawn.
    const real through = choose(nonzero3(scattering), dot3(share, left), (real)(1.0f));
    const real3 passed = scale3(left, 1.0f / max_real(through, (real)(1e-30f)));
    event.weight = choose(dense, choose(event.scattered, scattered, passed), event.weight);
    return event;
}

// How much comes through a medium from distance `begin` to `end` of a ray. key: of random numbers.
INLINE real3 medium_transmittance(SceneView view, natural medium, real3 origin, real3 direction,
                                  real begin, real end, natural key, mask lanes) {
    const real3 extinction = medium_extinction(view, medium);
    real3 left = transmittance_of(extinction, end - begin);
    #if ONDE_GRIDS
    const natural grid = RECORD_NATURAL(view.media, medium, MediumRecord, grid);
    const mask gridded = lanes & (grid != NO_INDEX);
    if_any (gridded) {
        const real3 through =
            grid_transmittance(view, grid, extinction, origin, direction, begin, end, key, gridded);
        left = choose(gridded, through, left);
    }
    #endif
    return left;
}
#endif

#endif
