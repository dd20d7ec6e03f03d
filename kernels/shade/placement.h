// How an instance places in the world what lies in its object's space.
#ifndef ONDE_SHADE_PLACEMENT_H
#define ONDE_SHADE_PLACEMENT_H

#include "shade/moved.h"

// Row k of the linear part of an instance's matrix.
#define INSTANCE_ROW(view, i, matrix, k)                                                           \
    make3(RECORD(view.bvh.instances, i, BvhInstance, matrix[4 * k]),                               \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[4 * k + 1]),                           \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[4 * k + 2]))

#define INSTANCE_OFFSET(view, i, matrix)                                                           \
    make3(RECORD(view.bvh.instances, i, BvhInstance, matrix[3]),                                   \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[7]),                                   \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[11]))

// The way from the world to the object, read once for all that is asked of it: most of what a hit
// on an instance costs are these reads.
typedef struct {
    mask placed; // lanes on an instance; what the others have is in the world already
    natural index;
#if ONDE_INSTANCES
    real3 row[3], offset;
    #if ONDE_SHUTTER
    real3 to_world[3], to_world_offset; // the way back
    #endif
#endif
} Placement;

#if ONDE_INSTANCES && ONDE_SHUTTER
// A placement whose way to the object is that of the shutter's opening, at the moment of the view,
// with its way back.
INLINE Placement placed_at_moment(SceneView view, Placement p) {
    p.to_world[0] = INSTANCE_ROW(view, p.index, object_to_world, 0);
    p.to_world[1] = INSTANCE_ROW(view, p.index, object_to_world, 1);
    p.to_world[2] = INSTANCE_ROW(view, p.index, object_to_world, 2);
    p.to_world_offset = INSTANCE_OFFSET(view, p.index, object_to_world);
    const mask moves =
        p.placed & (RECORD_NATURAL(view.bvh.instances, p.index, BvhInstance, steps) != 0u);
    if_any (moves) {
        const MovedRows moved = moved_rows(view, p.index, moves);
        for (uint row = 0; row < 3; row++) {
            p.row[row] = choose(moves, moved.to_object[row], p.row[row]);
            p.to_world[row] = choose(moves, moved.to_world[row], p.to_world[row]);
        }
        p.offset = choose(moves, moved.object_offset, p.offset);
        p.to_world_offset = choose(moves, moved.world_offset, p.to_world_offset);
    }
    return p;
}
#endif

// Row k of the way from the object to the world, and its offset.
#if ONDE_SHUTTER
    #define TO_WORLD_ROW(view, p, k) (p).to_world[k]
    #define TO_WORLD_OFFSET(view, p) (p).to_world_offset
#else
    #define TO_WORLD_ROW(view, p, k) INSTANCE_ROW(view, (p).index, object_to_world, k)
    #define TO_WORLD_OFFSET(view, p) INSTANCE_OFFSET(view, (p).index, object_to_world)
#endif

INLINE Placement placement_of(SceneView view, natural instance) {
    Placement p;
    p.placed = instance != BVH_NONE;
    p.index = choose(p.placed, instance, (natural)(0u));
#if ONDE_INSTANCES
    p.row[0] = p.row[1] = p.row[2] = p.offset = splat3((real)(0.0f));
    if_any (p.placed) {
        p.row[0] = INSTANCE_ROW(view, p.index, world_to_object, 0);
        p.row[1] = INSTANCE_ROW(view, p.index, world_to_object, 1);
        p.row[2] = INSTANCE_ROW(view, p.index, world_to_object, 2);
        p.offset = INSTANCE_OFFSET(view, p.index, world_to_object);
    }
    #if ONDE_SHUTTER
    p = placed_at_moment(view, p);
    #endif
#endif
    return p;
}

#if ONDE_INSTANCES
// Inverse transpose: its length is how much shorter distances along it are in the world.
INLINE real3 unscaled_normal(Placement p, real3 n) {
    return madd3(p.row[2], n.z, madd3(p.row[1], n.y, scale3(p.row[0], n.x)));
}

INLINE real3 to_object_space(Placement p, real3 world) {
    return make3(dot3(p.row[0], world) + p.offset.x, dot3(p.row[1], world) + p.offset.y,
                 dot3(p.row[2], world) + p.offset.z);
}
#endif

// A normal of object space in the world.
INLINE real3 placed_normal(Placement p, real3 n) {
#if ONDE_INSTANCES
    if_any (p.placed) n = choose(p.placed, normalize3(unscaled_normal(p, n)), n);
#endif
    return n;
}

// A length of object space in the world, at most.
INLINE real placed_length(SceneView view, Placement p, real length) {
#if ONDE_INSTANCES
    if_any (p.placed) {
        const real scale = RECORD(view.bvh.instances, p.index, BvhInstance, scale);
        length = choose(p.placed, length * scale, length);
    }
#endif
    return length;
}

// Which side of a plane a point of the world is on.
typedef struct {
    real3 normal;  // of the plane, in the world
    real distance; // along it, from the plane to the point
} PlaneSide;

// `normal` and `plane` are the plane's own, in object space.
INLINE PlaneSide plane_side(Placement p, real3 normal, real plane, real3 point) {
    PlaneSide side;
    side.normal = normal;
    side.distance = dot3(normal, point) - plane;
#if ONDE_INSTANCES
    if_any (p.placed) {
        const real3 unscaled = unscaled_normal(p, normal);
        const real grows = 1.0f / length3(unscaled);
        const real within = dot3(normal, to_object_space(p, point)) - plane;
        side.normal = choose(p.placed, scale3(unscaled, grows), normal);
        side.distance = choose(p.placed, within * grows, side.distance);
    }
#endif
    return side;
}

// A tangent, and the sign of its bitangent: a mirror image turns the other way.
typedef struct {
    real3 direction;
    real sign;
} Tangent;

// A tangent of object space in the world.
INLINE Tangent placed_tangent(SceneView view, Placement p, Tangent t) {
#if ONDE_INSTANCES
    if_any (p.placed) {
        const real3 x = TO_WORLD_ROW(view, p, 0);
        const real3 y = TO_WORLD_ROW(view, p, 1);
        const real3 z = TO_WORLD_ROW(view, p, 2);
        const real3 world = make3(dot3(x, t.direction), dot3(y, t.direction), dot3(z, t.direction));
        const mask mirrored = p.placed & (dot3(x, cross3(y, z)) < 0.0f);
        t.direction = choose(p.placed, normalize3(world), t.direction);
        t.sign = choose(mirrored, -t.sign, t.sign);
    }
#endif
    return t;
}

#endif
