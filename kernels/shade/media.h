// What light meets between surfaces. A path knows the medium that it is in and the one around that;
// solids in solids in solids are more than it can tell.
//
// How a connection goes is one word: WAY_UNBENT where smooth solids let it pass, as no other way
// finds its light; and the media that it starts in.
#ifndef ONDE_SHADE_MEDIA_H
#define ONDE_SHADE_MEDIA_H

#include "math/random.h"
#include "shade/phase.h"
#include "shade/scene_view.h"

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
} MediumEvent;

// carried: what light has by channel. In proportion to it u.x picks the channel by whose extinction
// u.y draws the distance, of which the density is the mean over the channels.
INLINE MediumEvent medium_event(SceneView view, natural medium, real distance, real3 carried,
                                real2 u, mask lanes) {
    MediumEvent event;
    event.scattered = lanes & !lanes;
    event.at = distance;
    event.weight = splat3((real)(1.0f));
    const real3 extinction = medium_extinction(view, medium);
    const mask dense = lanes & nonzero3(extinction);
    if (!mask_bits(dense)) return event;
    const real3 scattering = RECORD3(view.media, medium, MediumRecord, scattering);
    const real all = carried.x + carried.y + carried.z;
    const real3 share = scale3(carried, 1.0f / max_real(all, (real)(1e-30f)));
    const real drawn = choose(u.x < share.x, extinction.x,
                              choose(u.x < share.x + share.y, extinction.y, extinction.z));
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
#endif

#endif
