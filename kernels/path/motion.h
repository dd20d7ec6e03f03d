// How what a pixel shows moves in the picture until the next frame.
#ifndef ONDE_PATH_MOTION_H
#define ONDE_PATH_MOTION_H

#include "shade/camera.h"
#include "shade/placement.h"
#include "trace/hits.h"

#if ONDE_MOTION

    #define MOVER_ROW(view, i, rows, k, stride)                                                    \
        make3(RECORD(view.movers, i, MoverRecord, rows[stride * k]),                               \
              RECORD(view.movers, i, MoverRecord, rows[stride * k + 1]),                           \
              RECORD(view.movers, i, MoverRecord, rows[stride * k + 2]))

// Of the hits of `found`.
INLINE natural mover_of(SceneView view, Hits hit, mask found) {
    const mask placed = found & (hit.instance != BVH_NONE);
    const natural instance = choose(placed, hit.instance, (natural)(0u));
    const natural primitive = choose(found & !placed, hit.primitive, (natural)(0u));
    return choose(placed, gather_natural(view.instance_movers, instance),
                  gather_natural(view.primitive_movers, primitive));
}

INLINE real3 corner_step(SceneView view, natural triangle, uint corner) {
    const natural i = triangle * 9u + 3u * corner;
    return make3(gather_real(view.corner_steps, i), gather_real(view.corner_steps, i + 1u),
                 gather_real(view.corner_steps, i + 2u));
}

// In the space of its mesh, the step of a point of a triangle that deforms.
INLINE real3 deforming_step(SceneView view, natural mover, Hits hit, mask deforms) {
    const natural first = RECORD_NATURAL(view.movers, mover, MoverRecord, first_triangle);
    const natural triangle = choose(deforms, hit.primitive + first, (natural)(0u));
    const real u = choose(deforms, hit.u, (real)(0.0f)), v = choose(deforms, hit.v, (real)(0.0f));
    const real3 first_two = madd3(corner_step(view, triangle, 1), u,
                                  scale3(corner_step(view, triangle, 0), 1.0f - u - v));
    return madd3(corner_step(view, triangle, 2), v, first_two);
}

// How the place in the world of a point that the rays of `found` have hit changes: by exactly 0
// where it stands still.
INLINE real3 surface_step(SceneView view, Hits hit, real3 point, mask found) {
    const natural i = mover_of(view, hit, found);
    const real3 offset = make3(RECORD(view.movers, i, MoverRecord, step[3]),
                               RECORD(view.movers, i, MoverRecord, step[7]),
                               RECORD(view.movers, i, MoverRecord, step[11]));
    real3 step = make3(dot3(MOVER_ROW(view, i, step, 0, 4), point) + offset.x,
                       dot3(MOVER_ROW(view, i, step, 1, 4), point) + offset.y,
                       dot3(MOVER_ROW(view, i, step, 2, 4), point) + offset.z);
    const mask deforms = found & (RECORD_NATURAL(view.movers, i, MoverRecord, deforms) != 0u);
    if_any (deforms) {
        const real3 own = deforming_step(view, i, hit, deforms);
        const real3 placed = make3(dot3(MOVER_ROW(view, i, to_world, 0, 3), own),
                                   dot3(MOVER_ROW(view, i, to_world, 1, 3), own),
                                   dot3(MOVER_ROW(view, i, to_world, 2, 3), own));
        step = choose(deforms, add3(step, placed), step);
    }
    return step;
}

// Where the environment that is seen in direction d is at the next frame.
INLINE real3 next_direction(SceneView view, real3 d) {
    const float turns = view.frame[1].environment_rotation - view.frame[0].environment_rotation;
    if (turns == 0.0f) return d;
    const SineCosine turn = sincos_turns((real)(turns));
    return make3(fma(turn.cosine, d.x, turn.sine * d.z), d.y,
                 fma(turn.cosine, d.z, -turn.sine * d.x));
}

// Where a point that the rays of `found` have hit is as the shutter opens.
INLINE real3 point_before(SceneView view, Hits hit, real3 point, mask found) {
    #if ONDE_SHUTTER && ONDE_INSTANCES
    Placement p = placement_of(view, choose(found, hit.instance, (natural)(BVH_NONE)));
    if_any (p.placed) {
        const real3 own = to_object_space(p, point);
        view.bvh.time = (real)(0.0f);
        p = placement_of(view, choose(found, hit.instance, (natural)(BVH_NONE)));
        point = choose(p.placed, add3(rows_times(p.to_world, own), p.to_world_offset), point);
    }
    #endif
    return point;
}

// How far a place of the film is from another one; the edges of panoramas are one.
INLINE real3 film_step(__global const FrameRecord* frame, real2 from, real2 to) {
    real right = to.x - from.x;
    #if ONDE_PROJECTIONS
    const float around = (float)(frame->width);
    if (is_panorama(frame)) right -= around * floor(right / around + 0.5f);
    #endif
    return make3(right, from.y - to.y, (real)(0.0f));
}

// Whether the camera sees what lies that way at all.
INLINE mask is_before(__global const FrameRecord* frame, real3 to) {
    #if ONDE_PROJECTIONS
    if (is_wide(frame)) return to.x == to.x;
    #endif
    return dot3(to, uniform3(frame->forward)) > 0.0f;
}

// In pixels, to the right and up, from where the middle of the lens sees what the ray has met,
// which is at infinity where that is nothing, to where that is at the next frame; 0 where the
// camera will have it behind itself, and for parallel rays to infinity.
INLINE real3 path_motion(SceneView view, real3 origin, real3 direction, Hits hit, mask lanes) {
    __global const FrameRecord *now = view.frame, *next = view.frame + 1;
    const mask found = lanes & (hit.primitive != BVH_NONE);
    real3 from = direction, to = next_direction(view, direction);
    if_any (found) {
        const real3 point = point_before(view, hit, madd3(direction, hit.t, origin), found);
        const real3 moved = add3(point, surface_step(view, hit, point, found));
        from = choose(found, sub3(point, uniform3(now->origin)), from);
        to = choose(found, sub3(moved, uniform3(next->origin)), to);
    }
    const real2 start = film_place(now, from), end = film_place(next, to);
    mask seen = lanes & is_before(next, to);
    if (now->orthographic || next->orthographic) seen = found;
    return choose(seen, film_step(now, start, end), zero3());
}

#endif

#endif
