// One sample of one pixel by the path-tracing estimator, every bounce written down. Compiled at
// width 1; the path has the bits that every other width has. The wave is that one path.
#include "film/tally.h"
#include "inspect/report.h"
#include "path/estimator.h"
#include "trace/trace.h"

// The lobes, each chosen with its probability.
INLINE void report_bsdf(__global BounceReport* report, SceneView view, MaterialPoint m, Bsdf b) {
#define REPORT_LOBE(NAME, name, Type, transmits)                                                   \
    if (HAS_LOBE(NAME) && b.has.name) lobes |= 1u << LOBE_##NAME;                                  \
    report->probability[LOBE_##NAME] = HAS_LOBE(NAME) ? b.probability.name : 0.0f;
    uint lobes = 0;
    LOBES(REPORT_LOBE)
#undef REPORT_LOBE
    report->lobes = lobes;
    const uint glossy = lobes >> LOBE_GLOSSY & 1u, dielectric = lobes >> LOBE_DIELECTRIC & 1u;
    report3(report->diffuse, lobes >> LOBE_DIFFUSE & 1u ? b.diffuse.albedo : zero3());
    m.albedo = mirror_albedo(m.cosine); // f0 is told as if no microfacet shadowed others
    report3(report->f0, glossy ? glossy_load(view, m).f0 : zero3());
    report->alpha = glossy ? WIDEST_ALPHA(b.glossy.alpha) : dielectric ? b.dielectric.alpha : 0.0f;
    report->eta = bsdf_eta(b);
}

// What the estimator decided with: the light that it chose and the lobes.
INLINE void explain_bounce(SceneView view, Path path, Hits hit, Sampler sampler, uint bounce,
                           __global BounceReport* report) {
    const uint found = hit.primitive != BVH_NONE;
    const Surface s = surface_at(view, path.origin, path.direction, hit, (mask)(found));
    report_hit(&report->hit, path.origin, path.direction, hit, s);
    report3(report->throughput, path.throughput);
    report->light = NO_INDEX;
    report->light_pdf = 0.0f;
    if (!found) return;
    const Basis basis = surface_basis(s);
    real3 wo = to_local(basis, negate3(path.direction));
    wo.z = max_real(wo.z, (real)(1e-4f));
    const Bsdf b = material_bsdf(view, s, basis, wo);
    report_bsdf(report, view, material_point(view, s, wo), b);
    if (view.frame->light_count == 0) return;
    const real choice = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_CHOICE)).x;
    const real2 u = sampler_pair(sampler, bounce_dimension(bounce, DIMENSION_LIGHT));
    real2 rest = u;
    const real3 normal = bsdf_transmits(b) ? zero3() : valid_normal(view, s, path.direction);
    const Receiver at = receiver_at(s.position, normal);
    report->light = light_choice(view, at, choice, &rest, (mask)(1)).light;
    report->light_pdf = light_sample(view, at, choice, u, (mask)(1)).pdf;
}

// reports: as many as the path may have surfaces. radiance: of the sample.
__kernel void inspect_path(LAUNCH_PARAMETERS, SCENE_PARAMETERS, JOB_PARAMETERS,
                           __global BounceReport* reports, __global uint* report_count,
                           __global float* radiance) {
    if (count == 0 || get_global_id(0) != 0) return;
    ESTIMATOR(e);
    const SceneView view = e.view;
    const Sampler sampler = path_sampler(e, (natural)(0u));
    Path path = estimator_start(e, (natural)(0u));
    real3 sum = zero3();
    uint bounce = 0;
    for (bool alive = true; alive; bounce++) {
        __global BounceReport* report = reports + bounce;
        Hits hits = trace_closest(view.bvh, path.origin, path.direction, 1u);
#if ONDE_SEEN_THROUGH
        hits = estimator_pass(e, path, hits, (natural)(0u), bounce, (mask)(1));
#endif
        explain_bounce(view, path, hits, sampler, bounce, report);
        const PathVertex v = path_vertex(view, path, hits, sampler, bounce, (mask)(1));
        sum = add3(sum, v.emitted);
        report3(report->emitted, v.emitted);
        report3(report->light_direction, v.connection.direction);
        report->light_distance = v.connection.distance;
        report3(report->light_radiance, v.connection.value);
        report->blocked =
            v.connection.distance > 0.0f &&
            (ONDE_MEDIA || trace_occluded(view.bvh, v.connection.origin, v.connection.direction,
                                          v.connection.distance, 1u));
        real3 arrives = report->blocked ? zero3() : v.connection.value;
#if ESTIMATOR_TRANSLUCENT
        if (report->blocked) {
    #if ESTIMATOR_WAYS
            const natural way = v.connection.way;
    #else
            const natural way = 0u;
    #endif
            const real3 through = estimator_transmittance(
                e, v.connection.origin, v.connection.direction, v.connection.distance, way,
                (natural)(0u), bounce, (mask)(1));
            report->blocked = !nonzero3(through);
            arrives = mul3(v.connection.value, through);
            report3(report->light_radiance, arrives);
        }
#endif
        if (v.connection.distance > 0.0f && !report->blocked) sum = add3(sum, arrives);
        report3(report->next_direction, v.next.direction);
        report->next_pdf = v.next.pdf;
        report3(report->next_throughput, v.next.throughput);
        alive = v.alive != 0;
        report->alive = alive;
        path = v.next;
    }
    *report_count = bounce;
    report3(radiance, sum);
}
