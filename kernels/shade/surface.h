// What lies at a hit: position, normals, texture coordinates, material. No light, no BSDF.
#ifndef ONDE_SHADE_SURFACE_H
#define ONDE_SHADE_SURFACE_H

#include "shade/texture.h"
#include "trace/hits.h"

typedef struct {
    real3 position;
    real lift;       // by which rays leave the surface
    real3 geometric; // unit, on the side that the ray came from
    real3 normal;    // shading normal on that side, unit
    UvSets uv;
    real3 tint; // of its vertices' colours; multiplies the base colour
    natural material;
    natural light; // NO_INDEX when it does not emit; see SurfaceRecord
    mask front;    // whether that side is the front face
} Surface;

// A field of a surface's own record, a float or uint: SURFACE_FIELD(view, i, sphere.radius).
#define SURFACE_FIELD(view, i, field) RECORD(view.surfaces, i, SurfaceRecord, field)
#define SURFACE_NATURAL(view, i, field) RECORD_NATURAL(view.surfaces, i, SurfaceRecord, field)

// The one rule for ray origins: a hit is brought back to its surface, then a ray leaves it along
// the geometric normal by what rounding may have left between the two, and what traversal rounds
// when it looks for the surface again. Both are a few roundings of the hit's coordinates and of the
// surface's own size, as Pharr, Jakob and Humphreys count them (Physically Based Rendering, section
// 6.8); the length of the ray does not count, nor does the place that it came from.
#define ROUNDINGS 32.0f
#define ROUNDING 5.9604645e-8f // 2^-24: half of the distance from 1 to the next float

INLINE real largest_component(real3 v) {
    return max_component3(make3(fabs(v.x), fabs(v.y), fabs(v.z)));
}
INLINE real origin_lift(real3 position, real reach) {
    return (largest_component(position) + reach) * (ROUNDINGS * ROUNDING);
}
INLINE real3 offset_origin(real3 position, real3 normal, real lift) {
    return madd3(normal, lift, position);
}

// The same for rays whose line must not shift, as mirrors and grazing hits magnify that: moved on
// along the unit direction d until as clear of the surface. Rays that graze would have to go far
// and are lifted off for what is missing. `normal` is the geometric one, on either side.
#define GRAZING_COSINE 0.05f
typedef struct {
    real3 origin;
    real passed; // distance along the ray that is behind it
} AdvancedOrigin;
INLINE AdvancedOrigin advance_origin(real3 position, real3 normal, real3 d, real clear) {
    const real rise = dot3(d, normal), steepness = fabs(rise);
    AdvancedOrigin result;
    result.passed = clear / max_real(steepness, (real)(GRAZING_COSINE));
    const real lift = copysign(clear - result.passed * steepness, rise);
    result.origin = madd3(d, result.passed, madd3(normal, lift, position));
    return result;
}

// Shadow rays stop this share short of the light, so as not to hit the light itself.
#define SHADOW_SHORTENING (1.0f - 1e-4f)

// Row k of the linear part of an instance's matrix.
#define INSTANCE_ROW(view, i, matrix, k)                                                           \
    make3(RECORD(view.bvh.instances, i, BvhInstance, matrix[4 * k]),                               \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[4 * k + 1]),                           \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[4 * k + 2]))

#define INSTANCE_OFFSET(view, i, matrix)                                                           \
    make3(RECORD(view.bvh.instances, i, BvhInstance, matrix[3]),                                   \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[7]),                                   \
          RECORD(view.bvh.instances, i, BvhInstance, matrix[11]))

#if ONDE_INSTANCES
// Inverse transpose: its length is how much shorter distances along it are in the world.
INLINE real3 unscaled_normal(SceneView view, natural i, real3 n) {
    return madd3(INSTANCE_ROW(view, i, world_to_object, 2), n.z,
                 madd3(INSTANCE_ROW(view, i, world_to_object, 1), n.y,
                       scale3(INSTANCE_ROW(view, i, world_to_object, 0), n.x)));
}

INLINE real3 to_object_space(SceneView view, natural i, real3 world) {
    const real3 offset = INSTANCE_OFFSET(view, i, world_to_object);
    return make3(dot3(INSTANCE_ROW(view, i, world_to_object, 0), world) + offset.x,
                 dot3(INSTANCE_ROW(view, i, world_to_object, 1), world) + offset.y,
                 dot3(INSTANCE_ROW(view, i, world_to_object, 2), world) + offset.z);
}
#endif

// A normal of object space in the world, where the hit is on an instance.
INLINE real3 instance_normal(SceneView view, natural instance, real3 n) {
#if ONDE_INSTANCES
    const mask placed = instance != BVH_NONE;
    if (!mask_bits(placed)) return n;
    const natural i = choose(placed, instance, (natural)(0u));
    return choose(placed, normalize3(unscaled_normal(view, i, n)), n);
#else
    return n;
#endif
}

// A length of object space in the world, at most.
INLINE real instance_length(SceneView view, natural instance, real length) {
#if ONDE_INSTANCES
    const mask placed = instance != BVH_NONE;
    if (!mask_bits(placed)) return length;
    const natural i = choose(placed, instance, (natural)(0u));
    return choose(placed, length * RECORD(view.bvh.instances, i, BvhInstance, scale), length);
#else
    return length;
#endif
}

// How far a point of the world lies before the plane of a triangle, along the world's normal;
// `normal` and `plane` are the triangle's own, in object space.
INLINE real before_plane(SceneView view, natural instance, real3 normal, real plane, real3 point) {
    real distance = dot3(normal, point) - plane;
#if ONDE_INSTANCES
    const mask placed = instance != BVH_NONE;
    if_any (placed) {
        const natural i = choose(placed, instance, (natural)(0u));
        const real within = dot3(normal, to_object_space(view, i, point)) - plane;
        const real shrinks = length3(unscaled_normal(view, i, normal));
        distance = choose(placed, within / shrinks, distance);
    }
#endif
    return distance;
}

// A tangent of object space in the world, and the sign of its bitangent there: a mirror image
// turns the other way.
typedef struct {
    real3 direction;
    real sign;
} Tangent;

INLINE Tangent instance_tangent(SceneView view, natural instance, Tangent t) {
#if ONDE_INSTANCES
    const mask placed = instance != BVH_NONE;
    if (!mask_bits(placed)) return t;
    const natural i = choose(placed, instance, (natural)(0u));
    const real3 x = INSTANCE_ROW(view, i, object_to_world, 0);
    const real3 y = INSTANCE_ROW(view, i, object_to_world, 1);
    const real3 z = INSTANCE_ROW(view, i, object_to_world, 2);
    const real3 world = make3(dot3(x, t.direction), dot3(y, t.direction), dot3(z, t.direction));
    const mask mirrored = placed & (dot3(x, cross3(y, z)) < 0.0f);
    t.direction = choose(placed, normalize3(world), t.direction);
    t.sign = choose(mirrored, -t.sign, t.sign);
#endif
    return t;
}

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
INLINE ShapePoint shape_point(SceneView view, natural record, natural instance, real3 world,
                              real3 direction, mask lanes) {
    const natural i = choose(lanes, instance, (natural)(0u));
    real3 p = to_object_space(view, i, world);
    const natural kind = SURFACE_NATURAL(view, record, shape.shape);
    const real minor_radius = SURFACE_FIELD(view, record, shape.minor_radius);
    real3 d;
    d.x = dot3(INSTANCE_ROW(view, i, world_to_object, 0), direction);
    d.y = dot3(INSTANCE_ROW(view, i, world_to_object, 1), direction);
    d.z = dot3(INSTANCE_ROW(view, i, world_to_object, 2), direction);
    ShapeSide side = shape_side(kind, minor_radius, p);
    p = madd3(d, slide_back(side.outside, dot3(d, side.normal)), p);
    side = shape_side(kind, minor_radius, p);
    p = madd3(side.normal, -side.outside, p);
    const real3 to_world = INSTANCE_OFFSET(view, i, object_to_world);
    ShapePoint point;
    point.normal = side.normal;
    point.reach =
        2.0f + 1.0f / max_real(minor_radius, (real)(0.01f)); // a torus's roots are as good
    point.position.x = dot3(INSTANCE_ROW(view, i, object_to_world, 0), p) + to_world.x;
    point.position.y = dot3(INSTANCE_ROW(view, i, object_to_world, 1), p) + to_world.y;
    point.position.z = dot3(INSTANCE_ROW(view, i, object_to_world, 2), p) + to_world.z;
    return point;
}
#endif

// Where the corners of a triangle are among the vertices; the first vertex for other surfaces.
typedef struct {
    natural vertex[3];
} Corners;

INLINE Corners triangle_corners(SceneView view, natural record, mask triangle) {
    const natural zero = (natural)(0u);
    Corners c;
    c.vertex[0] = choose(triangle, SURFACE_NATURAL(view, record, triangle.vertex[0]), zero);
    c.vertex[1] = choose(triangle, SURFACE_NATURAL(view, record, triangle.vertex[1]), zero);
    c.vertex[2] = choose(triangle, SURFACE_NATURAL(view, record, triangle.vertex[2]), zero);
    return c;
}

INLINE real3 corner_normal(SceneView view, natural vertex) {
    return decode_octahedral(RECORD_NATURAL(view.vertices, vertex, VertexRecord, normal));
}
// u and v are the weights of corners 1 and 2.
INLINE real3 triangle_normal(SceneView view, Corners c, real u, real v) {
    const real3 n0 = corner_normal(view, c.vertex[0]), n1 = corner_normal(view, c.vertex[1]);
    const real3 n2 = corner_normal(view, c.vertex[2]);
    return normalize3(madd3(n2, v, madd3(n1, u, scale3(n0, 1.0f - u - v))));
}
// A number of the sets of texture coordinates after the first.
INLINE real interpolate_further(SceneView view, Corners c, uint number, real u, real v) {
    const uint stride = 2 * (ONDE_UV_SETS - 1);
    const real n0 = gather_real(view.uvs, c.vertex[0] * stride + number);
    const real n1 = gather_real(view.uvs, c.vertex[1] * stride + number);
    const real n2 = gather_real(view.uvs, c.vertex[2] * stride + number);
    return fma(n2, v, fma(n1, u, n0 * (1.0f - u - v)));
}
INLINE UvSets triangle_uv(SceneView view, Corners c, real u, real v) {
    UvSets uvs = same_in_all_sets(make2((real)(0.0f), (real)(0.0f)));
#if ONDE_TEXTURES
    const real w = 1.0f - u - v;
    real2 uv;
    uv.x = RECORD(view.vertices, c.vertex[2], VertexRecord, uv[0]) * v;
    uv.x = fma(RECORD(view.vertices, c.vertex[1], VertexRecord, uv[0]), u, uv.x);
    uv.x = fma(RECORD(view.vertices, c.vertex[0], VertexRecord, uv[0]), w, uv.x);
    uv.y = RECORD(view.vertices, c.vertex[2], VertexRecord, uv[1]) * v;
    uv.y = fma(RECORD(view.vertices, c.vertex[1], VertexRecord, uv[1]), u, uv.y);
    uv.y = fma(RECORD(view.vertices, c.vertex[0], VertexRecord, uv[1]), w, uv.y);
    uvs.set[0] = uv;
    for (uint k = 1; k < ONDE_UV_SETS; k++) {
        uvs.set[k].x = interpolate_further(view, c, 2 * (k - 1), u, v);
        uvs.set[k].y = interpolate_further(view, c, 2 * (k - 1) + 1, u, v);
    }
#endif
    return uvs;
}

#if ONDE_VERTEX_COLORS
// Two of the colour's 16-bit channels.
typedef struct {
    real low, high;
} Channels;

INLINE Channels corner_channels(SceneView view, natural vertex, uint word) {
    const natural bits = gather_natural(view.colors, vertex * 2u + word);
    Channels c;
    c.low = to_real(bits & 0xffffu) * (1.0f / 65535.0f);
    c.high = to_real(bits >> 16) * (1.0f / 65535.0f);
    return c;
}
INLINE Channels triangle_channels(SceneView view, Corners c, uint word, real u, real v) {
    const Channels c0 = corner_channels(view, c.vertex[0], word);
    const Channels c1 = corner_channels(view, c.vertex[1], word);
    const Channels c2 = corner_channels(view, c.vertex[2], word);
    const real w = 1.0f - u - v;
    Channels mean;
    mean.low = fma(c2.low, v, fma(c1.low, u, c0.low * w));
    mean.high = fma(c2.high, v, fma(c1.high, u, c0.high * w));
    return mean;
}
#endif

// The colour of a triangle's vertices, and its alpha.
INLINE real3 triangle_tint(SceneView view, Corners c, real u, real v) {
#if ONDE_VERTEX_COLORS
    const Channels red_green = triangle_channels(view, c, 0, u, v);
    return make3(red_green.low, red_green.high, triangle_channels(view, c, 1, u, v).low);
#else
    return splat3((real)(1.0f));
#endif
}
INLINE real triangle_alpha(SceneView view, Corners c, real u, real v) {
#if ONDE_VERTEX_COLORS
    return triangle_channels(view, c, 1, u, v).high;
#else
    return (real)(1.0f);
#endif
}

#if ONDE_NORMAL_MAPS
INLINE real3 corner_direction(natural word) {
    return decode_octahedral(word & ~1u);
}
// u and v are the weights of corners 1 and 2, which share the sign.
INLINE Tangent triangle_tangent(SceneView view, Corners c, real u, real v) {
    const natural word = gather_natural(view.tangents, c.vertex[0]);
    const real3 t0 = corner_direction(word);
    const real3 t1 = corner_direction(gather_natural(view.tangents, c.vertex[1]));
    const real3 t2 = corner_direction(gather_natural(view.tangents, c.vertex[2]));
    Tangent t;
    t.sign = choose((word & 1u) != 0u, (real)(-1.0f), (real)(1.0f));
    t.direction = madd3(t2, v, madd3(t1, u, scale3(t0, 1.0f - u - v)));
    return t;
}

// The normal told by the material's normal map (glTF 2.0, section 3.9.3), or n where it has none.
INLINE real3 mapped_normal(SceneView view, natural instance, Corners corners, real u, real v,
                           natural material, UvSets uv, real3 n) {
    const natural texture = material_texture(view, material, TEXTURE_NORMAL);
    const mask present = texture != NO_INDEX;
    if (!mask_bits(present)) return n;
    const real scale = RECORD(view.materials, material, MaterialRecord, normal_scale);
    real3 m = texture_data(view, texture, uv);
    m = make3(fma(m.x, (real)(2.0f), (real)(-1.0f)) * scale,
              fma(m.y, (real)(2.0f), (real)(-1.0f)) * scale, fma(m.z, (real)(2.0f), (real)(-1.0f)));
    const Tangent frame = instance_tangent(view, instance, triangle_tangent(view, corners, u, v));
    real3 tangent = frame.direction;
    tangent = madd3(n, -dot3(n, tangent), tangent);
    const real across = length3(tangent);
    const real3 t = scale3(tangent, 1.0f / max_real(across, (real)(1e-20f)));
    const real3 b = scale3(cross3(n, t), frame.sign);
    const real3 bent = madd3(n, m.z, madd3(b, m.y, scale3(t, m.x)));
    const mask usable = present & (across > 1e-4f) & (dot3(bent, bent) > 1e-8f);
    return choose(usable, normalize3(choose(usable, bent, n)), n);
}
#else
INLINE real3 mapped_normal(SceneView view, natural instance, Corners corners, real u, real v,
                           natural material, UvSets uv, real3 n) {
    return n;
}
#endif

#if ONDE_SPHERES
// Sets position and normals of the lanes whose surface is a sphere.
INLINE Surface on_sphere(SceneView view, natural record, real3 direction, Surface s, mask sphere) {
    const real3 center = RECORD3(view.surfaces, record, SurfaceRecord, sphere.center);
    const real radius = SURFACE_FIELD(view, record, sphere.radius);
    const real3 from = sub3(s.position, center);
    const real far = length3(from);
    const real slide = slide_back(far - radius, dot3(from, direction) / far);
    const real3 outward = normalize3(madd3(direction, slide, from));
    s.geometric = choose(sphere, outward, s.geometric);
    s.normal = choose(sphere, outward, s.normal);
    s.position = choose(sphere, madd3(outward, radius, center), s.position);
    return s;
}
#endif

// The surface at the hits of `lanes`; other lanes hold the first primitive's.
INLINE Surface surface_at(SceneView view, real3 origin, real3 direction, Hits hit, mask lanes) {
    const natural record = choose(lanes, hit.primitive, (natural)(0u));
    hit.instance = choose(lanes, hit.instance, (natural)(BVH_NONE));
    const real u = choose(lanes, hit.u, (real)(0.0f)), v = choose(lanes, hit.v, (real)(0.0f));
    Surface s;
    s.position = madd3(direction, hit.t, origin);
    const natural tag = SURFACE_NATURAL(view, record, any.tag);
    s.material = SURFACE_MATERIAL(tag);
    s.light = SURFACE_NATURAL(view, record, any.light);

    mask triangle = lanes;
#if ONDE_SPHERES || ONDE_SHAPES
    triangle = triangle & ((tag & (SURFACE_SPHERE | SURFACE_SHAPE)) == 0u);
#endif
    const Corners corners = triangle_corners(view, record, triangle);
    s.geometric = RECORD3(view.surfaces, record, SurfaceRecord, triangle.geometric);
    s.normal = s.geometric;
    real reach = SURFACE_FIELD(view, record, triangle.reach);
    const mask curved = triangle & ((tag & SURFACE_FLAT) == 0u);
    if_any (curved) // sixteen bits would bend the others, where they are mirrors, by 3e-5
        s.normal = choose(curved, triangle_normal(view, corners, u, v), s.normal);
    s.uv = triangle_uv(view, corners, u, v);
    s.tint = triangle_tint(view, corners, u, v);
#if ONDE_SPHERES
    const mask sphere = lanes & ((tag & SURFACE_SPHERE) != 0u);
    if_any (sphere) {
        s = on_sphere(view, record, direction, s, sphere);
        reach = choose(sphere, SURFACE_FIELD(view, record, sphere.radius), reach);
    }
#endif
#if ONDE_SHAPES
    const mask shape = lanes & ((tag & SURFACE_SHAPE) != 0u); // the others have no instance
    if_any (shape) {
        const ShapePoint point =
            shape_point(view, record, hit.instance, s.position, direction, shape);
        s.geometric = choose(shape, point.normal, s.geometric);
        s.normal = choose(shape, point.normal, s.normal);
        s.position = choose(shape, point.position, s.position);
        reach = choose(shape, point.reach, reach);
    }
#endif
    const real3 geometric = instance_normal(view, hit.instance, s.geometric);
    const real plane = SURFACE_FIELD(view, record, triangle.plane);
    const real before = before_plane(view, hit.instance, s.geometric, plane, s.position);
#if ONDE_SPHERES || ONDE_SHAPES
    const real3 round_position = s.position;
#endif
    s.position = madd3(geometric, -before, s.position);
#if ONDE_SPHERES || ONDE_SHAPES
    s.position = choose(triangle, s.position, round_position);
#endif
    s.lift = origin_lift(s.position, instance_length(view, hit.instance, reach));
    real3 normal = instance_normal(view, hit.instance, s.normal);
    normal = mapped_normal(view, hit.instance, corners, u, v, s.material, s.uv, normal);

    s.front = dot3(geometric, direction) < 0.0f;
    s.geometric = choose(s.front, geometric, negate3(geometric));
    normal = choose(dot3(normal, s.geometric) < 0.0f, negate3(normal), normal);
    const mask grazing = !(dot3(normal, direction) < -1e-3f); // NaN falls here too
    s.normal = choose(grazing, s.geometric, normal);
    return s;
}

#endif
