// One sample of one pixel by the Whitted estimator, its whole ray tree written down. Compiled at
// width 1; the tree has the bits that every other width has. The wave is that one path.
#include "film/tally.h"
#include "inspect/report.h"
#include "wavefront/tree_levels.h"

// The two parts of what a source adds, and how much of it arrives.
INLINE void explain_source(SceneView view, WhittedView w, TreeVertex v, uint index, real2 offset,
                           real3 color, __global SourceReport* report) {
    __global const SourceRecord* source = w.sources + index;
    const uint side = source->samples;
    const float share = 1.0f / (float)(side * side);
    float visible = 0.0f, diffuse = 0.0f, specular = 0.0f;
    for (uint k = 0; k < side * side; k++) {
        const real2 uv = make2(((float)(k % side) + offset.x) / (float)side,
                               ((float)(k / side) + offset.y) / (float)side);
        const SourceSample s = source_sample(source, uv, v.surface.position);
        const float cosine = dot3(v.surface.normal, s.direction);
        if (!s.lit || !(cosine > 0.0f)) continue;
        const float arrives = sample_visibility(view, w, v, s, 1u);
        visible += arrives * share;
        diffuse += arrives * share * PHONG(w, v, diffuse) * cosine;
        specular += arrives * share * PHONG(w, v, specular) * sample_highlight(w, v, s, cosine);
    }
    const real3 light = mul3(color, uniform3(source->strength));
    report->visible = visible;
    report3(report->diffuse, scale3(light, diffuse));
    report3(report->specular, scale3(light, specular));
}

INLINE void explain_node(SceneView view, WhittedView w, NodeArena a, uint slot, uint level,
                         uint sample, __global NodeReport* report, __global SourceReport* sources) {
    const TreeRay ray = load_tree_ray(a, slot);
    const Hits hit = load_hit_rows(node_hits(a), slot);
    const TreeVertex v = tree_vertex(view, w, ray, hit, 1);
    report_hit(&report->hit, ray.origin, ray.direction, hit, v.surface);
    report->hit.t = v.t;
    report->level = level;
    report->kind = ray.kind;
    report->alive = v.alive != 0;
    report3(report->factor, ray.factor);
    report->product = v.product;
    const float4 own = node_color(a, slot);
    report3(report->own, make3(own.x, own.y, own.z));
    report3(report->emission, zero3());
    report3(report->ambient, zero3());
    if (!v.found || !v.alive) return;
    const real3 color = phong_color(view, w, v);
    if (material_emits(view, v.surface.material, v.surface.front))
        report3(report->emission, material_emission(view, v.surface.material, v.surface.uv));
    report3(report->ambient, ambient_light(w, v, color));
    for (uint i = 0; i < w.settings->source_count; i++)
        explain_source(view, w, v, i, sample_offset(sample), color, sources + i);
}

// reports: capacity of them; sources: source_count for each. report_count: how many there are,
// or 0 when the tree does not fit.
__kernel void inspect_whitted(uint count, SCENE_PARAMETERS, JOB_PARAMETERS, TREE_PARAMETERS,
                              __global NodeReport* reports, __global SourceReport* source_reports,
                              uint report_capacity, __global uint* report_count) {
    if (count == 0 || get_global_id(0) != 0) return;
    SCENE_VIEW(view);
    WHITTED_VIEW(w);
    NODE_ARENA(arena);
    WAVE_JOB(job);
    *report_count = 0;
    TreeLevels trees;
    if (!grow_trees(view, w, job, arena, 0, 1, &trees)) return;
    const uint nodes_grown = trees.end[trees.count - 1];
    if (nodes_grown > report_capacity) return;
    for (uint level = 0; level < trees.count; level++)
        for (uint i = trees.begin[level]; i < trees.end[level]; i++) {
            explain_node(view, w, arena, i, level, first_sample, reports + i,
                         source_reports + i * w.settings->source_count);
            reports[i].parent = level ? as_uint(*node_lane(arena, NODE_PARENT, i)) : i;
        }
    fold_trees(w, arena, &trees);
    for (uint i = 0; i < nodes_grown; i++) {
        const float4 color = node_color(arena, i);
        report3(reports[i].returned, make3(color.x, color.y, color.z));
    }
    *report_count = nodes_grown;
}
