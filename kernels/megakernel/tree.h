// A node of a ray tree in one go: what is seen there, its connections, tested by the lanes that
// made them, and the next ray. For schedulers whose work items own their paths.
#ifndef ONDE_MEGAKERNEL_TREE_H
#define ONDE_MEGAKERNEL_TREE_H

#include "film/job.h"
#include "trace/trace.h"

#if ESTIMATOR_TREE

// Connections that are tested together, a group of lanes each.
typedef struct {
    Occlusion ways;
    real value[OCCLUDED_GROUPS];
    uint bits; // which are to be tested
} Connections;

// Replaces the values of connections by what arrives of them.
INLINE void answer(Estimator e, Connections* c, uint groups) {
    float arrives[OCCLUDED_GROUPS * ONDE_WIDTH];
    uint blocked = 0;
    if (c->bits) blocked = occluded_groups(e.view.bvh, &c->ways, groups, c->bits);
    for (uint g = 0; g < groups; g++) {
        const mask open = mask_from_bits((c->bits & ~blocked) >> g * ONDE_WIDTH);
        spill_real(arrives + g * ONDE_WIDTH, choose(open, (real)(1.0f), (real)(0.0f)));
    }
    #if ESTIMATOR_TRANSLUCENT
    for (uint g = 0; g < groups; g++) {
        const mask dim = mask_from_bits(blocked >> g * ONDE_WIDTH);
        if (!mask_bits(dim)) continue;
        const real through =
            estimator_transmittance(e, group_origin(&c->ways, g), group_direction(&c->ways, g),
                                    unspill_real(c->ways.distance + g * ONDE_WIDTH), (natural)(0u),
                                    (natural)(0u), 0, dim)
                .x;
        const real before = unspill_real(arrives + g * ONDE_WIDTH);
        spill_real(arrives + g * ONDE_WIDTH, choose(dim, through, before));
    }
    #endif
    for (uint g = 0; g < groups; g++) c->value[g] *= unspill_real(arrives + g * ONDE_WIDTH);
}

// The colour of nodes without their children. Adds their shadow rays to `tested`.
INLINE real3 node_color(Estimator e, TreeVertex v, State ray, natural id, mask lanes,
                        natural* tested) {
    ray.color = estimator_ambient(e, v, ray, lanes);
    real sum = (real)(0.0f);
    const uint count = estimator_connections(e);
    for (uint k = 0; k < count;) {
        const uint groups = min(estimator_same_source(e, k), (uint)OCCLUDED_GROUPS);
        Connections together;
        together.bits = 0;
        for (uint g = 0; g < groups; g++) {
            const Connection c = estimator_connection(e, v, &ray, id, k + g, &sum, lanes);
            const mask pending = lanes & (c.distance > 0.0f);
            put_group(&together.ways, g, c.origin, c.direction, c.distance);
            together.value[g] = choose(pending, c.value.x, (real)(0.0f));
            together.bits |= mask_bits(pending) << g * ONDE_WIDTH;
            *tested += one_for(pending);
        }
        answer(e, &together, groups);
        for (uint g = 0; g < groups; g++) sum += together.value[g];
        k += groups;
    }
    return estimator_color(e, v, ray, sum, lanes);
}

// Takes `ray` from its hit to the next ray of its tree. Returns the lanes whose trees go on; the
// others' are done, and `ray` holds their colour.
INLINE mask follow_tree(Estimator e, State* ray, Hits hits, natural id, mask lanes) {
    const TreeVertex v = estimator_look(e, *ray, hits, lanes);
    natural tested = (natural)(0u);
    ray->color = node_color(e, v, *ray, id, lanes, &tested);
    count_by_level(e.job.counters, COUNTER_SHADOW, ray->level, tested);
    return estimator_advance(e, v, ray, hits, id, lanes);
}

#endif

#endif
