// The path-tracing estimator: what happens at each vertex of a path. It knows nothing of queues,
// waves or films; it returns what should happen next (light found, a connection to a light, the
// next ray), and the schedulers store or loop on it.
#ifndef ONDE_PATH_PATH_H
#define ONDE_PATH_PATH_H

#include "path/ground.h"
#include "path/motion.h"
#include "path/scatter.h"
#include "path/state.h"
#include "shade/connection.h"
#include "shade/light.h"
#include "shade/passing.h"
#include "shade/vertex.h"

// Whether the camera sees the environment.
#ifndef ONDE_BACKGROUND
    #define ONDE_BACKGROUND 1
#endif

// The weight of light found by following the BSDF, against sampling the light.
INLINE real found_weight(real bsdf_pdf, real light_pdf) {
    return choose(bsdf_pdf > 0.0f, power_heuristic(bsdf_pdf, light_pdf), (real)(1.0f));
}

INLINE real3 path_background(SceneView view, Path path) {
    const FarLight far = environment_found(view, path.direction);
    real weight = found_weight(path.pdf, far.pdf);
#if ONDE_GROUND
    weight = choose(path.pdf == GROUND_PDF, (real)(0.0f), weight);
#endif
    return mul3(path.throughput, scale3(far.radiance, weight));
}

// What the path's last vertex was when it sampled a light.
INLINE Receiver path_receiver(Path path) {
    real3 position = path.origin;
#if ONDE_PANES // it has come straight through them since
    position = madd3(path.direction, -path.passed, position);
#endif
#if ONDE_LIGHT_TREE
    return receiver_at(position, path.normal);
#else
    return receiver_at(position, zero3());
#endif
}

INLINE real3 path_emission(SceneView view, Path path, real t, Surface s, mask lanes) {
    const mask emits =
        lanes & (s.light != NO_INDEX) & material_emits(view, SURFACE_EMITTER(s), s.front);
    if (!mask_bits(emits)) return zero3();
    const real3 radiance = material_emission(view, SURFACE_EMITTER(s), s.uv);
#if ONDE_PANES // light was sampled where the path was turned
    t += path.passed;
#endif
    const mask sampled = emits & (path.pdf > 0.0f);
    const real pdf = light_pdf(view, path_receiver(path), path.direction, t, s, sampled);
    const real weight = found_weight(path.pdf, pdf);
    return choose(emits, mul3(path.throughput, scale3(radiance, weight)), zero3());
}

// What unlit surfaces show: their colour, to whatever ray looks at them.
INLINE real3 path_unlit(SceneView view, Path path, Surface s, mask lanes) {
    const mask unlit = lanes & is_unlit(view, s.material);
    if (!mask_bits(unlit)) return zero3();
    return choose(unlit, mul3(path.throughput, material_color(view, s)), zero3());
}

INLINE Connection path_connection(SceneView view, Path path, Vertex v, Sampler sampler, uint bounce,
                                  real choice, mask lanes) {
    const real2 u = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_LIGHT));
    const LightSample light = light_sample(view, vertex_receiver(v), choice, u, lanes);
    const real3 wi = to_local(v.basis, light.direction);
    const BsdfValue f = bsdf_eval(v.bsdf, v.wo, wi);
    const real weight =
        choose(light.delta, (real)(1.0f), power_heuristic(light.pdf, f.pdf)) / light.pdf;
    Connection ray;
    ray.value = mul3(mul3(path.throughput, f.value), scale3(light.radiance, weight));
#if ONDE_DISPERSION
    ray.value = mul3(ray.value, wave_share(v, wi, path.dispersed));
#endif
    const mask useful = lanes & light.valid & true_side(v, wi, light.direction) &
                        nonzero3(f.value) & nonzero3(light.radiance);
    ray.origin = vertex_exit(v, light.direction);
    const real3 target = madd3(light.direction, light.distance, v.surface.position);
    const real3 to = sub3(target, ray.origin); // the origin's offset must not move the target
    const real length = length3(to);
    const mask finite = light.distance < INFINITE_DISTANCE;
    ray.direction = choose(finite, scale3(to, 1.0f / length), light.direction);
    ray.distance = choose(finite, length * SHADOW_SHORTENING, (real)(INFINITE_DISTANCE));
    ray.distance = choose(useful, ray.distance, (real)(0.0f));
    ray.target = light.group;
#if ONDE_WAYS
    ray.way = choose(light.delta, (natural)(WAY_UNBENT), (natural)(0u));
    #if ONDE_MEDIA
    const natural beyond = media_beyond(view, path.media, v.surface.material, v.surface.front);
    ray.way |= choose(wi.z < 0.0f, beyond, path.media);
    #endif
#endif
#if ONDE_TRAIL
    ray.diffuse = path.diffuse;
    ray.transmitted = path.transmitted;
    if (bounce == 0) {
        ray.diffuse = bsdf_diffuse_share(v.bsdf, v.wo, wi, f.value);
        ray.transmitted = choose(wi.z < 0.0f, (real)(1.0f), (real)(0.0f));
    }
#endif
    return ray;
}

#if ONDE_TRAIL
// The paths in `lanes` are guided by the surface that they have met, which they may see in mirrors.
INLINE void path_guide(SceneView view, Path path, Vertex v, mask lanes, PathVertex* result) {
    if (!HAS_AOVS_OF(GUIDE) || !mask_bits(lanes)) return;
    const real3 color = guide_color(mul3(path.throughput, material_color(view, v.surface)));
    result->aovs.denoise_albedo = choose(lanes, color, result->aovs.denoise_albedo);
    result->aovs.denoise_normal = choose(lanes, v.surface.normal, result->aovs.denoise_normal);
    result->guided = result->guided | lanes;
}
#endif

// The paths in `lanes` at the surfaces that they have hit, or at the environment.
INLINE PathVertex path_surface(SceneView view, Path path, Hits hit, Sampler sampler, uint bounce,
                               mask lanes) {
    PathVertex result;
    result.emitted = zero3();
    result.connection = no_connection();
    result.next = path;
    const mask found = lanes & (hit.primitive != BVH_NONE);
    const mask missed = lanes & !found;
    result.alive = found;
#if ONDE_ENVIRONMENT
    const bool is_seen = ONDE_BACKGROUND || bounce > 0;
    if (is_seen && mask_bits(missed))
        result.emitted = choose(missed, path_background(view, path), result.emitted);
#endif
#if ONDE_GROUPS
    result.group = (natural)(view.frame->environment_group);
#endif
#if ONDE_AOVS
    result.aovs = no_aovs();
    result.guided = lanes & !lanes;
    #if ONDE_MOTION
    if (HAS_AOV(MOTION) && bounce == 0)
        result.aovs.motion = path_motion(view, path.origin, path.direction, hit, lanes);
    #endif
#endif
#if ONDE_TRAIL
    result.guided = missed & (path.mirrored != 0u);
    result.aovs.denoise_albedo =
        choose(result.guided, guide_color(result.emitted), result.aovs.denoise_albedo);
#endif
    if (!mask_bits(found)) return result;

    Vertex v;
    v.surface = surface_at(view, path.origin, path.direction, hit, found);
    v.t = choose(found, hit.t, (real)(0.0f));
#if ONDE_ABSORPTION
    path.throughput = mul3(path.throughput, solid_transmittance(view, v.surface, v.t));
#endif
    const real3 emitted = path_emission(view, path, v.t, v.surface, found);
    result.emitted = choose(found, emitted, result.emitted);
    if (HAS_UNLIT) result.emitted = add3(result.emitted, path_unlit(view, path, v.surface, found));
#if ONDE_GROUPS
    result.group = choose(found, material_group(view, SURFACE_EMITTER(v.surface)), result.group);
#endif
#if ONDE_AOVS
    if (bounce == 0) result.aovs = first_surface(view, v, path.direction, found, result.aovs);
#endif
    if (bounce + 1 >= view.frame->max_depth) {
        result.alive = found & !found;
#if ONDE_TRAIL
        path_guide(view, path, v, found & (path.mirrored != 0u), &result);
#endif
        return result;
    }

    v.surface.normal = valid_normal(view, v.surface, path.direction);
    v.basis = surface_basis(v.surface);
#if ONDE_DISPERSION
    v.wave = path_wave(view, sampler, v.surface.material, found);
    v.surface.bend = v.wave.bend;
#endif
    v.wo = to_local(v.basis, negate3(path.direction));
    v.wo.z = max_real(v.wo.z, (real)(1e-4f));
    v.bsdf = material_bsdf(view, v.surface, v.basis, v.wo);
#if ONDE_TRAIL
    const mask mirror = bsdf_is_mirror(v.bsdf);
    path_guide(view, path, v, found & !mirror & (path.mirrored != 0u), &result);
#endif
    const real2 choice = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_CHOICE));
    if (view.frame->light_count > 0) {
        result.connection = path_connection(view, path, v, sampler, bounce, choice.x, found);
    }

    const real2 u = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_DIRECTION));
    const BsdfSample s = bsdf_sample(v.bsdf, v.wo, choice.y, u);
    const real3 direction = normalize3(to_world(v.basis, s.wi));
    result.next.origin = vertex_exit(v, direction);
    result.next.direction = direction;
    result.next.throughput = mul3(path.throughput, s.weight);
    result.next.pdf = choose(s.delta, (real)(0.0f), s.pdf);
#if ONDE_DISPERSION
    result.next.throughput = mul3(result.next.throughput, wave_share(v, s.wi, path.dispersed));
    result.next.dispersed = dispersed_along(v, s.wi, path.dispersed);
#endif
#if ONDE_LIGHT_TREE
    result.next.normal = vertex_receiver(v).normal;
#endif
#if ONDE_MEDIA
    const natural beyond = media_beyond(view, path.media, v.surface.material, v.surface.front);
    result.next.media = choose(s.wi.z < 0.0f, beyond, path.media);
#endif
#if ONDE_PANES
    result.next.pdf = choose(s.straight, path.pdf, result.next.pdf);
    result.next.passed = choose(s.straight, path.passed + v.t, (real)(0.0f));
    #if ONDE_LIGHT_TREE
    result.next.normal = choose(s.straight, path.normal, result.next.normal);
    #endif
#endif
#if ONDE_TRAIL
    result.next.mirrored = choose(mirror, path.mirrored, (natural)(0u));
    if (bounce == 0) {
        result.next.diffuse =
            bsdf_diffuse_share(v.bsdf, v.wo, s.wi, scale3(s.weight, result.next.pdf));
        result.next.transmitted = choose(s.wi.z < 0.0f, (real)(1.0f), (real)(0.0f));
    }
#endif
    result.alive =
        found & s.valid & true_side(v, s.wi, direction) & nonzero3(result.next.throughput);
    if (bounce >= view.frame->roulette_start) {
        result.alive = path_roulette(&result.next, sampler, bounce, result.alive);
    }
    return result;
}

// One vertex of the paths in `lanes`: `hit` is what their rays met. `bounce` counts from 0 at the
// first surface.
OUTLINED PathVertex path_vertex(SceneView view, Path path, Hits hit, Sampler sampler, uint bounce,
                                mask lanes) {
    mask arrived = lanes;
#if ONDE_MEDIA
    const MediumEvent event = path_event(view, path, hit, sampler, bounce, lanes);
    #if ONDE_GLOW
    const real3 glow = choose(lanes, mul3(path.throughput, event.glow), zero3());
    #endif
    path.throughput = mul3(path.throughput, event.weight);
    arrived = lanes & !event.scattered;
#endif
    PathVertex result = path_surface(view, path, hit, sampler, bounce, arrived);
#if ONDE_MEDIA
    path_scatter(view, path, event.at, sampler, bounce, event.scattered, &result);
#endif
#if ONDE_GROUND
    result.tested = 0;
    const mask missed = arrived & (hit.primitive == BVH_NONE);
    path_ground(view, path, sampler, bounce, missed, &result);
#endif
#if ONDE_GLOW
    result.emitted = add3(result.emitted, glow);
    result.glow = glow;
#endif
    return result;
}

#endif
