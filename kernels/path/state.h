// A path on its way, and what becomes of it at a vertex.
#ifndef ONDE_PATH_STATE_H
#define ONDE_PATH_STATE_H

#include "path/aovs.h"
#include "shade/camera.h"
#include "shade/connection.h"
#include "shade/vertex.h"

#if ONDE_TRAIL
    #define PATH_TRAIL TRAIL_COLUMNS
#else
    #define PATH_TRAIL NO_COLUMNS
#endif
#if ONDE_PANES
    #define PATH_PANES PANE_COLUMNS
#else
    #define PATH_PANES NO_COLUMNS
#endif
#if ONDE_LIGHT_TREE
    #define PATH_RECEIVER RECEIVER_COLUMNS
#else
    #define PATH_RECEIVER NO_COLUMNS
#endif
#if ONDE_DISPERSION
    #define PATH_WAVE WAVE_COLUMNS
#else
    #define PATH_WAVE NO_COLUMNS
#endif
#if ONDE_MEDIA
    #define PATH_MEDIA MEDIA_COLUMNS
#else
    #define PATH_MEDIA NO_COLUMNS
#endif
#define PATH_STATE(VECTOR, REAL, NATURAL)                                                          \
    PATH_COLUMNS(VECTOR, REAL, NATURAL)                                                            \
    PATH_TRAIL(VECTOR, REAL, NATURAL)                                                              \
    PATH_RECEIVER(VECTOR, REAL, NATURAL)                                                           \
    PATH_PANES(VECTOR, REAL, NATURAL)                                                              \
    PATH_WAVE(VECTOR, REAL, NATURAL) PATH_MEDIA(VECTOR, REAL, NATURAL)
COLUMNS_TYPE(Path, PATH_STATE);
#if ONDE_MEDIA
COLUMNS_CHOICE(Path, PATH_STATE)
#endif

typedef struct {
    real3 emitted;         // radiance found at this vertex
    Connection connection; // light sampled from here, for the path's own sum
    Path next;
    mask alive; // whether `next` goes on
#if ONDE_GROUPS
    natural group; // of lights, of what was found
#endif
#if ONDE_GLOW
    real3 glow; // of what was found, that of a medium, which is of no group
#endif
#if ONDE_AOVS
    Aovs aovs;   // those of rays and surfaces at the first vertex, guides where `guided`
    mask guided; // whether this is the vertex that guides
#endif
#if ONDE_GROUND
    uint tested; // rays to lights of the ground, by lane
#endif
} PathVertex;

// Radiance found of the vertex's group.
INLINE real3 grouped_emission(PathVertex v) {
#if ONDE_GLOW
    return sub3(v.emitted, v.glow);
#else
    return v.emitted;
#endif
}

INLINE Path path_start(__global const FrameRecord* frame, natural pixel, Sampler sampler) {
    const CameraRay ray = camera_ray(frame, pixel, sampler);
    Path path;
    path.origin = ray.origin;
    path.direction = ray.direction;
    path.throughput = splat3((real)(1.0f));
    path.pdf = (real)(0.0f);
#if ONDE_PANES
    path.passed = (real)(0.0f);
#endif
#if ONDE_DISPERSION
    path.dispersed = (natural)(0u);
#endif
#if ONDE_MEDIA
    path.media = (natural)(MEDIUM_AROUND);
#endif
#if ONDE_LIGHT_TREE
    path.normal = zero3();
#endif
#if ONDE_TRAIL
    path.diffuse = zero3();
    path.transmitted = (real)(0.0f);
    path.mirrored = (natural)(1u);
#endif
    return path;
}

// Ends paths that carry little; the survivors carry more.
INLINE mask path_roulette(Path* path, Sampler sampler, uint bounce, mask lanes) {
    const real survival = roulette_survival(path->throughput);
    const real u = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_ROULETTE)).x;
    path->throughput = scale3(path->throughput, 1.0f / survival);
    return lanes & (u < survival);
}

#endif
