// What the film holds of a path's first surface; shared/aovs.h is the list.
#ifndef ONDE_PATH_AOVS_H
#define ONDE_PATH_AOVS_H

#include "film/aovs.h"
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

// Distance along the camera's view axis.
INLINE real3 aov_depth(SceneView view, Vertex v, real3 direction) {
    const real setback = (real)(view.frame->setback);
    return splat3(fma(v.t, dot3(direction, uniform3(view.frame->forward)), setback));
}

// All that the program has, of the lanes that have found a surface.
INLINE Aovs first_surface(SceneView view, Vertex v, real3 direction, mask found) {
    Aovs all = no_aovs();
    #define ONDE_FIND_AOV(NAME, name, components)                                                  \
        if (HAS_AOV(NAME)) all.name = choose(found, aov_##name(view, v, direction), all.name);
    AOVS(ONDE_FIND_AOV)
    #undef ONDE_FIND_AOV
    return all;
}

#endif

#endif
