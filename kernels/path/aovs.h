// What the film holds of the surfaces that a path meets; shared/aovs.h is the list.
#ifndef ONDE_PATH_AOVS_H
#define ONDE_PATH_AOVS_H

#include "film/aovs.h"
#include "shade/camera_motion.h"
#include "shade/material.h"
#include "shade/vertex.h"

#if ONDE_AOVS

// Whether there is something: 1.
INLINE real3 aov_alpha(SceneView view, Vertex v, real3 direction) {
    return splat3((real)(1.0f));
}

// The share of light that the surface scatters: its base colour, in which textures are.
INLINE real3 aov_albedo(SceneView view, Vertex v, real3 direction) {
    return material_color(view, v.surface);
}

// The shading normal, in the world, on the side that is seen.
INLINE real3 aov_normal(SceneView view, Vertex v, real3 direction) {
    return v.surface.normal;
}

// Distance along the camera's view axis; from the camera where that sees more than a plane.
INLINE real3 aov_depth(SceneView view, Vertex v, real3 direction) {
    #if ONDE_PROJECTIONS
    if (is_wide(view.frame)) return splat3(v.t);
    #endif
    const real setback = (real)(view.frame->setback);
    return splat3(fma(v.t, dot3(direction, view_axis(view)), setback));
}

// Counted from the scene's origin.
INLINE real3 aov_position(SceneView view, Vertex v, real3 direction) {
    return v.surface.position;
}

// The first set of texture coordinates.
INLINE real3 aov_uv(SceneView view, Vertex v, real3 direction) {
    return make3(v.surface.uv.set[0].x, v.surface.uv.set[0].y, (real)(0.0f));
}

    // All of SURFACE that the program has, of the lanes that have found a surface, in `all`.
    #define ONDE_FIND_SURFACE(name)                                                                \
        all.name = choose(found, aov_##name(view, v, direction), all.name);
    #define ONDE_FIND_RAY(name)
    #define ONDE_FIND_GUIDE(name)
    #define ONDE_FIND_LIGHT(name)
    #define ONDE_FIND_SAMPLE(name)
    #define ONDE_FIND_AOV(NAME, name, word, letters, SOURCE)                                       \
        if (HAS_AOV(NAME)) {                                                                       \
            ONDE_FIND_##SOURCE(name)                                                               \
        }
INLINE Aovs first_surface(SceneView view, Vertex v, real3 direction, mask found, Aovs all) {
    AOVS(ONDE_FIND_AOV)
    return all;
}

// The colour that guides a denoiser: what is brighter than white says no more.
INLINE real3 guide_color(real3 color) {
    return make3(min_real(color.x, (real)(1.0f)), min_real(color.y, (real)(1.0f)),
                 min_real(color.z, (real)(1.0f)));
}

#endif

#endif
