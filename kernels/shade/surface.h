// What lies at a hit: position, normals, texture coordinates, material. No light, no BSDF.
#ifndef ONDE_SHADE_SURFACE_H
#define ONDE_SHADE_SURFACE_H

#include "shade/bulge.h"
#include "shade/normal_map.h"
#include "shade/origins.h"
#include "shade/shape_point.h"
#include "trace/hits.h"

typedef struct {
    real3 position;
    real lift;       // by which rays leave the surface
    real bulge;      // how far the curved surface that it stands for lies above it on that side
    real3 geometric; // unit, on the side that the ray came from
    real3 normal;    // shading normal on that side, unit
#if ONDE_NORMAL_MAPS
    real3 coat_normal; // the same of varnish
#endif
#if ONDE_ANISOTROPY
    real3 grain; // along which microfacets are rougher; about unit, about across the normal
#endif
#if ONDE_DISPERSION
    real bend; // of the light that comes here; 0 of the d line
#endif
    UvSets uv;
    real3 tint; // of its vertices' colours; multiplies the base colour
    natural material;
#if ONDE_BLENDS
    natural emitter; // the one that it glows by, and passes rays
#endif
    natural light; // NO_INDEX when it does not emit; see SurfaceRecord
    mask front;    // whether that side is the front face
} Surface;

#if ONDE_SPHERES
// Position, normals and lift for the lanes whose surface is a sphere that their rays met at `met`.
INLINE Surface on_sphere(SceneView view, natural record, real3 met, real3 direction, Surface s,
                         mask sphere) {
    const real3 center = RECORD3(view.surfaces, record, SurfaceRecord, sphere.center);
    const real radius = SURFACE_FIELD(view, record, sphere.radius);
    const real3 from = sub3(met, center);
    const real far = length3(from);
    const real slide = slide_back(far - radius, dot3(from, direction) / far);
    const real3 outward = normalize3(madd3(direction, slide, from));
    s.position = choose(sphere, madd3(outward, radius, center), s.position);
    s.geometric = choose(sphere, outward, s.geometric);
    s.normal = choose(sphere, outward, s.normal);
    s.lift = choose(sphere, origin_lift(s.position, radius), s.lift);
    return s;
}
#endif

#if ONDE_SHAPES
// The same for shapes.
INLINE Surface on_shape(SceneView view, natural record, Placement placement, real3 met,
                        real3 direction, Surface s, mask shape) {
    const ShapePoint point = shape_point(view, record, placement, met, direction);
    const real3 outward = placed_normal(placement, point.normal);
    const real reach = placed_length(view, placement, point.reach);
    s.position = choose(shape, point.position, s.position);
    s.geometric = choose(shape, outward, s.geometric);
    s.normal = choose(shape, outward, s.normal);
    s.lift = choose(shape, origin_lift(s.position, reach), s.lift);
    return s;
}
#endif

// The same for all lanes, as triangles. The normals are those of fronts.
INLINE Surface on_triangle(SceneView view, natural record, Placement placement, Corners corners,
                           real3 met, real3 direction, real u, real v, natural tag, Surface s,
                           mask curved) {
    const real3 normal = RECORD3(view.surfaces, record, SurfaceRecord, triangle.geometric);
    const real plane = SURFACE_FIELD(view, record, triangle.plane);
    const PlaneSide side = plane_side(placement, normal, plane, met);
    s.position = madd3(side.normal, -side.distance, met);
    const real reach = as_real(SURFACE_REACH_BITS(tag));
    s.lift = origin_lift(s.position, placed_length(view, placement, reach));
    s.geometric = s.normal = side.normal;
    s.bulge = (real)(0.0f);
#if ONDE_CURVED
    if_any (curved) { // sixteen bits would bend the others, where they are mirrors, by 3e-5
        const real3 bent = placed_normal(placement, triangle_normal(view, corners, u, v));
        s.normal = choose(curved, bent, s.normal);
        const mask front = dot3(side.normal, direction) < 0.0f;
        const real bulge = triangle_bulge(view, record, u, v, front);
        s.bulge = choose(curved, placed_length(view, placement, bulge), s.bulge);
    }
#endif
    return s;
}

// Both normals on the side that the ray came from.
INLINE Surface facing(Surface s, real3 direction) {
    s.front = dot3(s.geometric, direction) < 0.0f;
    s.geometric = choose(s.front, s.geometric, negate3(s.geometric));
    s.normal = choose(dot3(s.normal, s.geometric) < 0.0f, negate3(s.normal), s.normal);
#if ONDE_NORMAL_MAPS
    s.coat_normal =
        choose(dot3(s.coat_normal, s.geometric) < 0.0f, negate3(s.coat_normal), s.coat_normal);
#endif
    const mask grazing = !(dot3(s.normal, direction) < -1e-3f); // NaN falls here too
    s.normal = choose(grazing, s.geometric, s.normal);
    return s;
}

#if ONDE_CURVED
// Whether a ray in direction d leaves the curved surface that a triangle stands for, though not the
// triangle.
INLINE mask leaves_curve(Surface s, real3 d) {
    return (s.bulge > 0.0f) & (dot3(d, s.geometric) <= 0.0f) & (dot3(d, s.normal) > 0.0f);
}
// Where it does.
INLINE real3 curve_exit(Surface s) {
    return offset_origin(s.position, s.geometric, s.lift + s.bulge);
}
#endif

#if ONDE_ANISOTROPY
// The grain of a surface of which `tangent` is where u grows (KHR_materials_anisotropy). Shapes
// without texture coordinates have it about the vertical.
INLINE real3 surface_grain(SceneView view, Surface s, Tangent tangent, mask triangle) {
    const real3 about = make3(s.normal.z, (real)(0.0f), -s.normal.x);
    real3 t = choose(triangle, tangent.direction, about);
    t = normalize3(madd3(s.normal, -dot3(s.normal, t), t));
    const real sign = choose(triangle, tangent.sign, (real)(1.0f));
    const real3 b = scale3(cross3(s.normal, t), sign);
    real2 turn = make2(RECORD(view.materials, s.material, MaterialRecord, grain[0]),
                       RECORD(view.materials, s.material, MaterialRecord, grain[1]));
    #if ONDE_TEXTURES
    const natural texture = material_texture(view, s.material, TEXTURE_ANISOTROPY);
    const mask present = texture != NO_INDEX;
    if_any (present) {
        const real3 texel = texture_data(view, texture, s.uv);
        const real x = fma(texel.x, (real)(2.0f), (real)(-1.0f));
        const real y = fma(texel.y, (real)(2.0f), (real)(-1.0f));
        const real2 turned = make2(fma(turn.x, x, -turn.y * y), fma(turn.y, x, turn.x * y));
        turn.x = choose(present, turned.x, turn.x);
        turn.y = choose(present, turned.y, turn.y);
    }
    #endif
    return madd3(b, turn.y, scale3(t, turn.x));
}
#endif

#if ONDE_BLENDS
    #define SURFACE_EMITTER(s) (s).emitter
// Of the material and the one that it is blended with, the one that a ray meets: drawn from the
// bits of where it does, which the sampler has made as random as it is.
INLINE natural met_material(SceneView view, natural material, UvSets uv, Hits hit) {
    const natural other = RECORD_NATURAL(view.materials, material, MaterialRecord, other);
    const mask blended = other != NO_INDEX;
    if (!mask_bits(blended)) return material;
    real share = RECORD(view.materials, material, MaterialRecord, blend);
    #if ONDE_TEXTURES
    share *= texture_data(view, material_texture(view, material, TEXTURE_BLEND), uv).x;
    #endif
    const natural bits = hash_natural(as_natural(hit.t) ^ hash_natural(as_natural(hit.u)));
    const real u = to_real(hash_natural(bits ^ as_natural(hit.v)) >> 8u) * (1.0f / 16777216.0f);
    return choose(blended & (u < share), other, material);
}
#else
    #define SURFACE_EMITTER(s) (s).material
#endif

// The surface at the hits of `lanes`; other lanes hold the first primitive's.
INLINE Surface surface_at(SceneView view, real3 origin, real3 direction, Hits hit, mask lanes) {
    const natural record = choose(lanes, hit.primitive, (natural)(0u));
    const Placement placement =
        placement_of(view, choose(lanes, hit.instance, (natural)(BVH_NONE)));
    const real u = choose(lanes, hit.u, (real)(0.0f)), v = choose(lanes, hit.v, (real)(0.0f));
    const real3 met = madd3(direction, hit.t, origin);
    const natural tag = SURFACE_NATURAL(view, record, any.tag);
    mask triangle = lanes;
#if ONDE_SPHERES || ONDE_SHAPES
    triangle = triangle & ((tag & (SURFACE_SPHERE | SURFACE_SHAPE)) == 0u);
#endif
    const Corners corners = triangle_corners(view, record, triangle);
    Surface s;
    s.material = SURFACE_MATERIAL(tag);
    s.light = SURFACE_NATURAL(view, record, any.light);
#if ONDE_DISPERSION
    s.bend = (real)(0.0f);
#endif
    s.uv = triangle_uv(view, corners, u, v);
    s.tint = triangle_tint(view, corners, u, v);
#if ONDE_BLENDS
    s.emitter = s.material;
    s.material = met_material(view, s.material, s.uv, hit);
#endif
    s = on_triangle(view, record, placement, corners, met, direction, u, v, tag, s,
                    triangle & ((tag & SURFACE_FLAT) == 0u));
#if ONDE_SPHERES
    const mask sphere = lanes & ((tag & SURFACE_SPHERE) != 0u);
    if_any (sphere) s = on_sphere(view, record, met, direction, s, sphere);
#endif
#if ONDE_SHAPES
    const mask shape = lanes & ((tag & SURFACE_SHAPE) != 0u); // the others have no instance
    if_any (shape) s = on_shape(view, record, placement, met, direction, s, shape);
#endif
#if ONDE_NORMAL_MAPS
    s.coat_normal = s.normal;
    const natural map = material_texture(view, s.material, TEXTURE_NORMAL);
    const real scale = RECORD(view.materials, s.material, MaterialRecord, normal_scale);
    s.normal = mapped_normal(view, placement, corners, u, v, map, scale, s.uv, s.normal);
    if (ONDE_LOBES >> LOBE_COAT & 1u) {
        const natural coat_map = material_texture(view, s.material, TEXTURE_CLEARCOAT_NORMAL);
        const real coat_scale =
            RECORD(view.materials, s.material, MaterialRecord, clearcoat_normal_scale);
        s.coat_normal = mapped_normal(view, placement, corners, u, v, coat_map, coat_scale, s.uv,
                                      s.coat_normal);
    }
#endif
    s = facing(s, direction);
#if ONDE_ANISOTROPY
    s.grain = zero3();
    const mask grained =
        lanes & (RECORD(view.materials, s.material, MaterialRecord, anisotropy) > 0.0f);
    if_any (grained) { // else there may be no tangents
        const Tangent tangent =
            placed_tangent(view, placement, triangle_tangent(view, corners, u, v));
        s.grain = choose(grained, surface_grain(view, s, tangent, triangle), s.grain);
    }
#endif
    return s;
}

// The basis of a surface's shading normal, whose first axis its grain is.
INLINE Basis surface_basis(Surface s) {
#if ONDE_ANISOTROPY
    return make_basis_along(s.normal, s.grain);
#else
    return make_basis(s.normal);
#endif
}

#endif
