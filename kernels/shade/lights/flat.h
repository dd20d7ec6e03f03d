// What the flat lights share: triangles and disks, spanned by two edges from a point.
#ifndef ONDE_SHADE_LIGHTS_FLAT_H
#define ONDE_SHADE_LIGHTS_FLAT_H

#include "shade/lights/light_type.h"

typedef struct {
    real3 origin, edge1, edge2;
    real area;
    real orientation; // +1, or -1 when the front face is on the other side of edge1 x edge2
    natural material;
} FlatLight;

#define LOAD_FLAT(view, light, name, start, first, second)                                         \
    {                                                                                              \
        LIGHT_FIELD3(view, light, name.start), LIGHT_FIELD3(view, light, name.first),              \
            LIGHT_FIELD3(view, light, name.second), LIGHT_FIELD(view, light, name.area),           \
            LIGHT_FIELD(view, light, name.orientation), LIGHT_MATERIAL(view, light)                \
    }

// b: weights of the edges at the point; uv: its texture coordinates; opacity: how much of the light
// is there.
INLINE LightSample flat_sample(SceneView view, FlatLight f, real2 b, UvSets uv, real opacity,
                               real3 from) {
    const real3 to = sub3(madd3(f.edge2, b.y, madd3(f.edge1, b.x, f.origin)), from);
    const real distance2 = dot3(to, to);
    LightSample s = no_light_sample();
    s.distance = sqrt(distance2);
    s.direction = scale3(to, 1.0f / s.distance);
    const real facing = -dot3(normalize3(cross3(f.edge1, f.edge2)), s.direction) * f.orientation;
    s.radiance = scale3(material_emission(view, f.material, uv), opacity);
    const real cosine = fabs(facing);
    s.pdf = distance2 / max_real(cosine * f.area, (real)(1e-30f));
    s.valid = (cosine > 1e-6f) & material_emits(view, f.material, facing > 0.0f);
    return s;
}

INLINE Emission flat_emit(SceneView view, FlatLight f, real2 b, UvSets uv, real opacity, real pmf,
                          EmissionNumbers u) {
    Emission e = no_emission();
    e.position = madd3(f.edge2, b.y, madd3(f.edge1, b.x, f.origin));
    e.normal = scale3(normalize3(cross3(f.edge1, f.edge2)), f.orientation);
    e.lift = origin_lift(e.position, largest_component(f.edge1) + largest_component(f.edge2));
    const real3 radiance = scale3(material_emission(view, f.material, uv), opacity);
    return emit_from_face(view, f.material, e, radiance, f.area, pmf, u);
}

#endif
