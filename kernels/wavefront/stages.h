// The stages of a wave, each over a range [begin, end) of slots, for any estimator. They know lanes
// and slots, but not who launches them: the kernels around them are in staged.cl and fused.cl.
#ifndef ONDE_WAVEFRONT_STAGES_H
#define ONDE_WAVEFRONT_STAGES_H

#include "megakernel/tree.h"
#include "wavefront/deliver.h"

// Paths `id` = slot begin to end of the wave, on their way; their sums are zero.
INLINE void stage_generate(Estimator e, WaveView wave, uint begin, uint end) {
    for (uint plane = 0; plane <= WAVE_PLANES; plane++)
        for (uint i = begin; i < end; i++)
            wave.sums[plane * wave.state.stride + i] = (float4)(0.0f);
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const natural id = choose(lanes, lane_index() + i, (natural)(begin));
        store_id(wave, i, lane_index() + i);
#if ESTIMATOR_CONNECTS_START
        const Step step = estimator_start(e, id, lanes);
        store_state(wave.state, i, step.next);
        store_alive(wave, i, step.alive);
        store_connection(wave_connections(wave), i, step.connection);
#else
        store_state(wave.state, i, estimator_start(e, id));
#endif
    }
}

#if ONDE_SEEN_THROUGH
// Sends rays on that pass what they have hit.
INLINE void pass_columns(Estimator e, WaveView wave, uint bounce, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const Hits hits = load_hits(wave_hits(wave), i);
        const State state = load_state(wave.state, i);
        const mask may = may_pass(e.view, hits, state.direction, estimator_culls(state, lanes),
                                  lanes & (hits.primitive != BVH_NONE));
        if (!mask_bits(may)) continue;
        const natural id = choose(lanes, load_id(wave, i), (natural)(0u));
        store_hits(wave_hits(wave), i, estimator_pass(e, state, hits, id, bounce, may));
    }
}
#endif

INLINE void stage_intersect(Estimator e, WaveView wave, uint bounce, uint begin, uint end) {
    trace_columns(e.view.bvh, wave.state, wave_hits(wave), bounce, begin, end);
#if ONDE_SEEN_THROUGH
    pass_columns(e, wave, bounce, begin, end);
#endif
    for (uint i = begin; i < end; i += ONDE_WIDTH)
        count_tree_rays(e.job, COUNTER_EXTENSION, wave, i, group_lanes(i, end));
}

INLINE void stage_shade(Estimator e, WaveView wave, uint bounce, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const natural id = choose(lanes, load_id(wave, i), (natural)(0u));
        const State state = load_state(wave.state, i);
        const Hits hits = load_hits(wave_hits(wave), i);
#if ONDE_IDS
        if (bounce == 0) store_seen(e.job, id, hits.primitive, hits.instance, mask_bits(lanes));
#endif
        const Step step = estimator_vertex(e, state, hits, id, bounce, lanes);
#if ESTIMATOR_EMITS
        const uint emitting = mask_bits(lanes & nonzero3(step.emitted));
        add_to_sums(wave, id, step.emitted, emitting);
#endif
#if ONDE_GROUPS
        add_to_groups(wave, id, step.group, grouped_emission(step), emitting);
    #if ONDE_GLOW
        add_to_groups(wave, id, (natural)(0u), step.glow, emitting);
    #endif
#endif
#if ONDE_AOVS
        if (bounce == 0) {
            store_aovs(wave, id, AOV_SOURCE_SURFACE, step.aovs, mask_bits(lanes));
            store_aovs(wave, id, AOV_SOURCE_RAY, step.aovs, mask_bits(lanes));
        }
#endif
#if ONDE_TRAIL
        store_aovs(wave, id, AOV_SOURCE_GUIDE, step.aovs, mask_bits(lanes & step.guided));
        add_light(wave, id, step.emitted, bounce, trail_shares(state), emitting);
#endif
        store_connection(wave_connections(wave), i, step.connection);
        store_state(wave.state, i, step.next);
        store_alive(wave, i, step.alive);
    }
}

// The connections that are to be tested, of the group at slot i.
INLINE mask pending_connections(WaveView wave, uint i, uint end) {
    const real distance = load_real(column(wave_connections(wave), RAY_DISTANCE, i));
    return group_lanes(i, end) & (distance > 0.0f);
}

INLINE void test_connections(Estimator e, WaveView wave, FilmView film, const uint* slots,
                             uint count, uint vertex) {
#if ONDE_MEDIA // which are asked on all ways
    uint blocked = ~0u >> (32u - count);
#else
    uint blocked = occluded_slots(e.view.bvh, wave_connections(wave), slots, count);
#endif
#if ESTIMATOR_TRANSLUCENT
    float3 transmittance[OCCLUDED_SLOTS];
    for (uint k = 0; k < count; k++) transmittance[k] = (float3)(1.0f);
    blocked = find_transmittance(e, wave, slots, blocked, vertex, transmittance);
#endif
    for (uint k = 0; k < count; k++) {
        if (blocked >> k & 1) continue;
#if ESTIMATOR_TRANSLUCENT
        deliver(e, wave, film, slots[k], vertex, transmittance[k]);
#else
        deliver(e, wave, film, slots[k], vertex, (float3)(1.0f));
#endif
    }
}

// Tests the connections of a vertex, the camera or light being vertex 0, and delivers what arrives.
// Returns how many there were.
OUTLINED uint stage_connect(Estimator e, WaveView wave, FilmView film, uint vertex, uint begin,
                            uint end) {
    uint slots[OCCLUDED_SLOTS];
    uint count = 0, tested = 0;
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask pending = pending_connections(wave, i, end);
        uint bits = mask_bits(pending);
        tested += popcount(bits);
        count_tree_rays(e.job, COUNTER_SHADOW, wave, i, pending);
        for (; bits; bits &= bits - 1) {
            slots[count++] = i + lowest_bit(bits);
            if (count < OCCLUDED_SLOTS) continue;
            test_connections(e, wave, film, slots, count, vertex);
            count = 0;
        }
    }
    if (count > 0) test_connections(e, wave, film, slots, count, vertex);
    return tested;
}

#if ESTIMATOR_TREE
// Connection k > 0 of a vertex whose first one is a matter of shading.
INLINE void stage_sample(Estimator e, WaveView wave, uint k, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const natural id = choose(lanes, load_id(wave, i), (natural)(0u));
        State state = load_state(wave.state, i);
        const TreeVertex vertex = estimator_look(e, state, load_hits(wave_hits(wave), i), lanes);
        real sum = load_sums(wave, id);
        const Connection connection = estimator_connection(e, vertex, &state, id, k, &sum, lanes);
        store_sums(wave, id, splat3(sum), mask_bits(lanes));
        store_connection(wave_connections(wave), i, connection);
        store_state(wave.state, i, state);
    }
}

// The next ray of each tree, or its end.
INLINE void stage_advance(Estimator e, WaveView wave, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const natural id = choose(lanes, load_id(wave, i), (natural)(0u));
        State state = load_state(wave.state, i);
        const Hits hits = load_hits(wave_hits(wave), i);
        const TreeVertex vertex = estimator_look(e, state, hits, lanes);
        state.color = estimator_color(e, vertex, state, load_sums(wave, id), lanes);
        const mask alive = estimator_advance(e, vertex, &state, hits, id, lanes);
        // A tree that has ended leaves its colour; one that goes on starts its next sum.
        store_sums(wave, id, choose(alive, zero3(), state.color), mask_bits(lanes));
        store_state(wave.state, i, state);
        store_alive(wave, i, alive);
    }
}

// All of a vertex and its connections, and the next ray: for chunks that one work item owns.
INLINE void stage_visit(Estimator e, WaveView wave, uint begin, uint end) {
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const mask lanes = group_lanes(i, end);
        const natural id = choose(lanes, load_id(wave, i), (natural)(0u));
        State state = load_state(wave.state, i);
        const mask alive = follow_tree(e, &state, load_hits(wave_hits(wave), i), id, lanes);
        store_sums(wave, id, state.color, mask_bits(lanes & !alive));
        store_state(wave.state, i, state);
        store_alive(wave, i, alive);
    }
}
#endif

// How many paths of the range go on.
INLINE uint count_alive(WaveView wave, uint begin, uint end) {
    uint count = 0;
    for (uint i = begin; i < end; i += ONDE_WIDTH)
        count += popcount(mask_bits(group_lanes(i, end) & load_alive(wave, i)));
    return count;
}

// Moves the paths that go on to consecutive slots of `to` from `first`; returns their number. In
// place it is safe for first <= begin: the write position never passes the read position.
OUTLINED uint stage_extend(WaveView wave, Columns to, uint begin, uint end, uint first) {
    uint next = first;
    for (uint i = begin; i < end; i += ONDE_WIDTH) {
        const uint bits = mask_bits(group_lanes(i, end) & load_alive(wave, i));
        move_columns(wave.state, i, to, next, MOVED_COLUMNS, bits);
        next += popcount(bits);
    }
    return next - first;
}

// What the paths have gathered goes to the film, path by path.
INLINE void stage_accumulate(Estimator e, WaveView wave, FilmView film, uint begin, uint end) {
#if ESTIMATOR_SPLATS
    uint contributed = 0, unblocked = 0;
    for (uint i = begin; i < end; i++) {
        contributed += wave.sums[i].w > 0.0f;
        unblocked += (uint)wave.sums[i].x;
    }
    estimator_tell(e, contributed, unblocked);
#else
    for (uint i = begin; i < end; i++) {
        const float kept = kept_share(film, wave.sums[i]);
        if (!film_add(film, e.job, i, wave.sums[i] * kept)) continue;
        uint plane = 0;
    #define ONDE_ACCUMULATE_AOV(NAME, name, word, letters, SOURCE)                                 \
        if (AOV_SOURCE_##SOURCE != AOV_SOURCE_SAMPLE && HAS_AOV(NAME)) {                           \
            const float4 value = wave.sums[++plane * wave.state.stride + i];                       \
            film_add_aov(film, e.job, i, plane,                                                    \
                         AOV_SOURCE_##SOURCE == AOV_SOURCE_LIGHT ? value * kept : value);          \
        }
        AOVS(ONDE_ACCUMULATE_AOV)
    #undef ONDE_ACCUMULATE_AOV
        film_add_sample_aovs(film, e.job, i, plane, wave.sums[i], kept);
        for (uint g = 0; g < ONDE_GROUPS; g++)
            film_add_aov(film, e.job, i, FILM_GROUPS + g,
                         wave.sums[(WAVE_GROUPS + g) * wave.state.stride + i] * kept);
    }
#endif
}

#endif
