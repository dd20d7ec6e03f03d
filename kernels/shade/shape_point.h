// Where rays meet shapes: position and normal, by the equation that a shape has in its own space.
#ifndef ONDE_SHADE_SHAPE_POINT_H
#define ONDE_SHADE_SHAPE_POINT_H

#include "shade/placement.h"

// How far a point that is `outside` a round surface by a rounding error moves on along its ray to
// be on it; `rise` is the ray direction's part along the outward normal. Where the ray grazes this
// is left to projection.
INLINE real slide_back(real outside, real rise) {
    return choose(fabs(rise) > 0.01f, -outside / rise, (real)(0.0f));
}

#if ONDE_SHAPES
// A point on a shape: where it lies in the world, and its outward normal in object space.
typedef struct {
    real3 position, normal;
    real reach;
} ShapePoint;

// Its normal, and how far outside p lies, both in object space.
typedef struct {
    real3 normal;
    real outside;
} ShapeSide;

INLINE ShapeSide shape_side(natural kind, real minor_radius, real3 p) {
    const real zero = (real)(0.0f), one = (real)(1.0f);
    const real rho = max_real(sqrt(fma(p.x, p.x, p.z * p.z)), (real)(1e-20f));
    const real3 radial = make3(p.x / rho, zero, p.z / rho);
    const real up = choose(p.y < 0.0f, -one, one);

    const real3 tube = sub3(p, radial); // from the centre of the torus's tube
    const mask torus = kind == SHAPE_TORUS, ellipsoid = kind == SHAPE_ELLIPSOID;
    const real3 from = choose(torus, tube, p);
    const real far = max_real(length3(from), (real)(1e-20f));
    ShapeSide side; // of torus and ellipsoid
    side.normal = scale3(from, 1.0f / far);
    side.outside = far - choose(torus, minor_radius, one);

    const real slant = 0.70710678f;
    const real above_side = (rho + p.y - 1.0f) * slant;
    const mask disk = kind == SHAPE_DISK;
    const mask base = (kind == SHAPE_CONE) & (-p.y > above_side);
    const mask cap = (kind == SHAPE_CYLINDER) & (fabs(p.y) > rho);
    const mask flat_face = disk | base | cap;
    const real facing = choose(cap, up, choose(base, -one, one));
    const real3 slope = make3(radial.x * slant, slant, radial.z * slant);
    const mask cone = kind == SHAPE_CONE;
    const real3 round_normal = choose(cone, slope, radial);
    const real round_outside = choose(cone, above_side, rho - 1.0f);
    const real flat_outside = fma(facing, p.y, choose(cap, -one, zero));
    const mask smooth = torus | ellipsoid;
    const real3 faced = choose(flat_face, make3(zero, facing, zero), round_normal);
    side.normal = choose(smooth, side.normal, faced);
    side.outside = choose(smooth, side.outside, choose(flat_face, flat_outside, round_outside));
    return side;
}

// The point of the shape next to a world position on it, up to rounding, along a ray that met it.
INLINE ShapePoint shape_point(SceneView view, natural record, Placement placement, real3 world,
                              real3 direction) {
    real3 p = to_object_space(placement, world);
    const natural kind = SURFACE_NATURAL(view, record, shape.shape);
    const real minor_radius = SURFACE_FIELD(view, record, shape.minor_radius);
    const real3 d = make3(dot3(placement.row[0], direction), dot3(placement.row[1], direction),
                          dot3(placement.row[2], direction));
    ShapeSide side = shape_side(kind, minor_radius, p);
    p = madd3(d, slide_back(side.outside, dot3(d, side.normal)), p);
    side = shape_side(kind, minor_radius, p);
    p = madd3(side.normal, -side.outside, p);
    const real3 to_world = TO_WORLD_OFFSET(view, placement);
    ShapePoint point;
    point.normal = side.normal;
    // A torus's roots are as good.
    point.reach = 2.0f + 1.0f / max_real(minor_radius, (real)(0.01f));
    point.position.x = dot3(TO_WORLD_ROW(view, placement, 0), p) + to_world.x;
    point.position.y = dot3(TO_WORLD_ROW(view, placement, 1), p) + to_world.y;
    point.position.z = dot3(TO_WORLD_ROW(view, placement, 2), p) + to_world.z;
    return point;
}
#endif

#endif
