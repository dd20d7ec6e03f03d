// One sample of one pixel by the Whitted estimator, its whole ray tree written down level by level.
// Compiled at width 1; the tree has the bits that every other width has. The wave is that one path.
#include "chapter/whitted/estimator.h"
#include "film/tally.h"
#include "inspect/report.h"
#include "megakernel/tree.h"

// A node of the tree: its ray, and what it meets.
typedef struct {
    WhittedRay ray;
    Hits hits;
} TreeNode;

// How much of a connection arrives.
INLINE float arriving(Estimator e, Connection c) {
    Connections one;
    put_group(&one.ways, 0, c.origin, c.direction, c.distance);
    one.value[0] = 1.0f;
    one.bits = c.distance > 0.0f;
    answer(e, &one, 1);
    return one.value[0];
}

// The two parts of what a source adds, and how much of it arrives.
INLINE void explain_source(Estimator e, WhittedVertex v, __global const SourceRecord* source,
                           real3 color, __global SourceReport* report) {
    const WhittedView w = e.w;
    const uint count = samples_of(source);
    const float share = 1.0f / (float)count;
    const real2 offset = sample_offset(e.job.first_sample);
    float visible = 0.0f, diffuse = 0.0f, specular = 0.0f;
    for (uint k = 0; k < count; k++) {
        const real2 uv = grid_point(source, k, offset);
        const SourceSample s = source_sample(source, uv, v.surface.position);
        const float cosine = dot3(v.surface.normal, s.direction);
        const Connection c = sample_connection(w, v, source, uv, 1);
        const float arrives = arriving(e, c) * share;
        visible += arrives;
        if (!(arrives > 0.0f)) continue;
        diffuse += arrives * PHONG(w, v, diffuse) * cosine;
        specular += arrives * PHONG(w, v, specular) * sample_highlight(w, v, s, cosine);
    }
    const real3 light = mul3(color, uniform3(source->intensity));
    report->visible = visible;
    report3(report->diffuse, scale3(light, diffuse));
    report3(report->specular, scale3(light, specular));
}

INLINE void explain_node(Estimator e, TreeNode node, WhittedVertex v, __global NodeReport* report,
                         __global SourceReport* sources) {
    report_hit(&report->hit, node.ray.origin, node.ray.direction, node.hits, v.surface);
    report->hit.t = v.t;
    report->level = node.ray.level;
    report->kind = node.ray.kind;
    report->alive = v.alive != 0;
    report3(report->factor, arrival_factor(e.w, node.ray, v));
    report->product = v.product;
    report3(report->emission, zero3());
    report3(report->ambient, zero3());
    if (!v.found || !v.alive) return;
    const real3 color = phong_color(e.view, e.w, v);
    report3(report->emission, surface_emission(e.view, v, 1));
    report3(report->ambient, ambient_light(e.w, v, color));
    for (uint i = 0; i < e.w.settings->source_count; i++)
        explain_source(e, v, e.w.sources + i, color, sources + i);
}

// What each node returns: its own colour and its children's, in their order, deepest level first.
INLINE void fold_reports(Estimator e, __global NodeReport* reports, uint count) {
    for (uint end = count; end > 1;) {
        uint begin = end - 1;
        while (reports[begin - 1].level == reports[end - 1].level) begin--;
        for (uint i = begin; i < end; i++) {
            __global float* sum = reports[reports[i].parent].returned;
            const real3 light = mul3(uniform3(reports[i].factor), uniform3(reports[i].returned));
            report3(sum, add_light(e.w, uniform3(sum), light));
        }
        end = begin;
    }
}

// nodes and reports: capacity of them; sources: source_count for each. report_count: how many there
// are, or 0 when the tree does not fit.
__kernel void inspect_whitted(LAUNCH_PARAMETERS, SCENE_PARAMETERS,
                              JOB_PARAMETERS ESTIMATOR_PARAMETERS, __global TreeNode* tree,
                              __global NodeReport* reports, __global SourceReport* source_reports,
                              uint capacity, __global uint* report_count) {
    if (count == 0 || get_global_id(0) != 0) return;
    ESTIMATOR(e);
    *report_count = 0;
    tree[0].ray = estimator_start(e, 0u);
    reports[0].parent = 0;
    uint grown = 1, tested = 0;
    for (uint i = 0; i < grown; i++) {
        TreeNode node;
        node.ray = tree[i].ray;
        node.hits = trace_closest(e.view.bvh, node.ray.origin, node.ray.direction, 1u);
#if ONDE_SEEN_THROUGH
        node.hits = estimator_pass(e, node.ray, node.hits, (natural)(0u), 0, (mask)(1));
#endif
        const WhittedVertex v = whitted_vertex(e.view, e.w, node.ray, node.hits, 1);
        explain_node(e, node, v, reports + i, source_reports + i * e.w.settings->source_count);
        const real3 color = node_color(e, v, node.ray, 0u, 1, &tested);
        report3(reports[i].own, color);
        report3(reports[i].returned, color);
        if (node.ray.level + 1 >= e.w.settings->max_depth) continue;
        for (uint k = 0; k < most_children(e.w); k++) {
            const WhittedChild child = whitted_child(e.w, v, node.ray.kind, k);
            if (!child.exists) continue;
            if (grown == capacity) return;
            tree[grown].ray = child.ray;
            reports[grown++].parent = i;
        }
    }
    fold_reports(e, reports, grown);
    *report_count = grown;
}
