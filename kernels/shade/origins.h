// Where rays begin that leave a surface, and where those end that go to a light.
#ifndef ONDE_SHADE_ORIGINS_H
#define ONDE_SHADE_ORIGINS_H

#include "math/vector.h"

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

#endif
