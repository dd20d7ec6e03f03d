// How much of a texture a pixel sees, which says how coarse a level of it may be looked up.
#ifndef ONDE_SHADE_FOOTPRINT_H
#define ONDE_SHADE_FOOTPRINT_H

#include "shade/camera.h"
#include "shade/placement.h"

#if ONDE_MIP_TEXTURES
// The width of a pixel at distance t along a ray of the camera: that of its cone (Akenine-Moeller
// et al. 2021, Improved Shader and Texture Level of Detail Using Ray Cones) where it is narrowest.
// Away from the picture's middle, pixels are seen from further off and aslant.
INLINE real pixel_width(__global const FrameRecord* frame, real3 direction, real t) {
    #if ONDE_PROJECTIONS
    if (is_wide(frame)) return t / sqrt(wide_place(frame, direction).density);
    #endif
    const real step = length3(uniform3(frame->step_x));
    if (frame->orthographic) return step;
    const real cosine = dot3(direction, uniform3(frame->forward));
    return step * t * square(cosine) / frame->focus_distance;
}

// The same in the space of the object, along its longest axis.
INLINE real width_in_object(Placement p, real width) {
    #if ONDE_INSTANCES
    real least = dot3(p.row[0], p.row[0]);
    least = min_real(least, dot3(p.row[1], p.row[1]));
    least = min_real(least, dot3(p.row[2], p.row[2]));
    return choose(p.placed, width * safe_sqrt(least), width);
    #else
    return width;
    #endif
}

// And in the first set of texture coordinates at the hits of `lanes`, where they grow least: what
// is looked up is never wider than the pixel.
INLINE real pixel_in_uv(SceneView view, real3 direction, Hits hit, mask lanes) {
    const natural record = choose(lanes, hit.primitive, (natural)(0u));
    const Placement placement =
        placement_of(view, choose(lanes, hit.instance, (natural)(BVH_NONE)));
    const real width = width_in_object(placement, pixel_width(view.frame, direction, hit.t));
    return choose(lanes, width * gather_real(view.uv_scales, record), (real)(0.0f));
}
#endif

#endif
