// The ground under a scene: a plane that is not there but for the scene's shadow and reflection on
// it. Rays that show the scene (the camera's, and those that mirrors and clear glass send on) and
// find nothing else see the environment through the plane, less by the share of its light that the
// scene keeps from a white, diffuse plane; and what glossy varnish reflects of the scene, but not
// of the environment. No other ray meets the plane: it throws no light back.
#ifndef ONDE_PATH_GROUND_H
#define ONDE_PATH_GROUND_H

#include "path/state.h"
#include "shade/fresnel.h"
#include "shade/light.h"
#include "shade/microfacet.h"
#include "shade/passing.h"
#include "shade/vertex.h"

#ifndef ONDE_GROUND
    #define ONDE_GROUND 0
#endif

// The density of rays that the ground has reflected: no light was sampled along them, as with 0,
// and they do not see the environment.
#define GROUND_PDF (-1.0f)

#define GROUND_ALPHA 0.04f // of the varnish, whose microfacets are those of roughness 0.2
#define GROUND_IOR 1.5f

#if ONDE_GROUND

typedef struct {
    real3 position;
    real3 kept;      // the share of light that the scene keeps from the plane
    real3 direction; // of the reflection
    real reflectance;
    uint tested; // rays, by lane
} Ground;

INLINE mask sees_ground(SceneView view, real3 origin, real3 direction, real pdf) {
    return (pdf == 0.0f) & (direction.y < 0.0f) & (origin.y > view.frame->ground_height);
}

INLINE real3 reflect_on_ground(real3 direction, real2 u) {
    const real3 wo = make3(direction.x, direction.z, -direction.y); // the plane's normal is +z here
    const real3 wi = reflect_about(wo, sample_visible_normal(wo, (real)(GROUND_ALPHA), u));
    return make3(-wi.x, wi.z, -wi.y);
}

// Where the rays of `lanes` meet the plane. choice, u: of the light; v: of the reflection. One
// sample of light: 0 where it is not blocked, so that plain ground has no noise.
OUTLINED Ground ground_at(SceneView view, real3 origin, real3 direction, real choice, real2 u,
                          real2 v, natural key, mask lanes) {
    Ground g;
    const real height = (real)(view.frame->ground_height);
    const real t = choose(lanes, (height - origin.y) / direction.y, (real)(0.0f));
    g.position = madd3(direction, t, origin);
    g.position.y = height;
    const real cosine = choose(lanes, -direction.y, (real)(1.0f));
    g.direction = reflect_on_ground(
        choose(lanes, direction, make3((real)(0.0f), (real)(-1.0f), (real)(0.0f))), v);
    g.reflectance = fresnel_dielectric(cosine, (real)(GROUND_IOR));

    const LightSample light = far_light_sample(view, choice, u, lanes);
    const mask lit = lanes & light.valid & (light.direction.y > 0.0f);
    g.tested = mask_bits(lit);
    g.kept = zero3();
    if (!g.tested) return g;
    mask blocked = lit & mask_from_bits(trace_occluded(view.bvh, g.position, light.direction,
                                                       light.distance, g.tested));
    const real share = choose(blocked, light.direction.y / light.pdf, (real)(0.0f));
    g.kept = mul3(scale3(light.radiance, share), uniform3(view.frame->ground_share));
    #if ONDE_ALPHA || ONDE_STRAIGHT
    const real3 through = ray_transmittance(
        view, g.position, light.direction, light.distance, light.direction, lanes & !lanes,
        choose(light.delta, (natural)(WAY_UNBENT), (natural)(MEDIUM_AROUND)), key, blocked);
    g.kept = mul3(g.kept, sub3(splat3((real)(1.0f)), through));
    #endif
    return g;
}

// What the paths in `lanes`, which have met no surface, see of the ground.
INLINE void path_ground(SceneView view, Path path, Sampler sampler, uint bounce, mask lanes,
                        PathVertex* result) {
    const mask ground = lanes & sees_ground(view, path.origin, path.direction, path.pdf);
    if (!mask_bits(ground)) return;
    const Ground g = ground_at(view, path.origin, path.direction,
                               sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_CHOICE)).x,
                               sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_LIGHT)),
                               sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_DIRECTION)),
                               stream_key(sampler, connection_dimension(bounce)), ground);
    const real3 left = sub3(splat3((real)(1.0f)), g.kept);
    result->emitted = choose(ground, mul3(result->emitted, left), result->emitted);
    result->tested = g.tested;
    #if ONDE_AOVS
    const real3 alpha = splat3((g.kept.x + g.kept.y + g.kept.z) * (1.0f / 3.0f));
    result->aovs.alpha = choose(ground, alpha, result->aovs.alpha);
    #endif
    if (bounce + 1 >= view.frame->max_depth) return;
    Path next;
    next.origin = g.position;
    next.direction = g.direction;
    next.throughput = scale3(path.throughput, g.reflectance);
    next.pdf = (real)(GROUND_PDF);
    const mask alive = ground & (g.direction.y > 0.0f);
    result->alive = result->alive | path_roulette(&next, sampler, bounce, alive);
    result->next.origin = choose(ground, next.origin, result->next.origin);
    result->next.direction = choose(ground, next.direction, result->next.direction);
    result->next.throughput = choose(ground, next.throughput, result->next.throughput);
    result->next.pdf = choose(ground, next.pdf, result->next.pdf);
    #if ONDE_PANES
    result->next.passed = choose(ground, (real)(0.0f), result->next.passed);
    #endif
    #if ONDE_TRAIL
    result->next.mirrored = choose(ground, (natural)(0u), result->next.mirrored);
    #endif
}
#endif

#endif
