// The whole path in one loop, its state in registers: the same estimators, sample by sample, as the
// wavefront. `count` is the number of paths.
#include "film/film.h"
#include "film/light_shares.h"
#include "film/tally.h"
#include "megakernel/tree.h"

// What the lanes of a group have gathered.
typedef struct {
    real3 sum;
    natural contributed, unblocked; // of estimators that splat
#if ONDE_AOVS
    Aovs aovs;
#endif
#if ONDE_GROUPS
    real3 groups[ONDE_GROUPS];
#endif
} Gathered;

#if ESTIMATOR_SPLATS
// Adds the connections of the lanes in `bits` to their pixels.
INLINE void add_splats(Estimator e, FilmView film, Connection c, natural id, uint vertex, uint bits,
                       Gathered* gathered) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], target[ONDE_WIDTH], path[ONDE_WIDTH];
    float unblocked[ONDE_WIDTH], contributed[ONDE_WIDTH];
    spill_real(x, c.value.x);
    spill_real(y, c.value.y);
    spill_real(z, c.value.z);
    spill_real(target, as_real(c.target));
    spill_real(path, as_real(id));
    spill_real(unblocked, (real)(0.0f));
    spill_real(contributed, (real)(0.0f));
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        const float4 told = estimator_splat(e, film, as_uint(path[k]), vertex, as_uint(target[k]),
                                            (float3)(x[k], y[k], z[k]));
        unblocked[k] = told.x;
        contributed[k] = told.w;
    }
    gathered->unblocked += as_natural(to_integer(unspill_real(unblocked)));
    gathered->contributed |= choose(unspill_real(contributed) > 0.0f, (natural)(1u), (natural)(0u));
}
#endif

#if ONDE_AOVS
    // Gathers what the lanes have of each AOV of a source.
    #define ONDE_GATHER_AOV(NAME, name, word, letters, SOURCE)                                     \
        if (AOV_SOURCE_##SOURCE == source && HAS_AOV(NAME))                                        \
            sum->name = choose(lanes, add3(sum->name, all.name), sum->name);
INLINE void gather_aovs(uint source, Aovs all, mask lanes, Aovs* sum){AOVS(ONDE_GATHER_AOV)}
    #if ONDE_TRAIL
INLINE void gather_light(real3 value, uint surfaces, LightShares shares, mask lanes, Aovs* sum) {
    gather_aovs(AOV_SOURCE_LIGHT, light_aovs(value, surfaces, shares), lanes, sum);
}
    #endif
#endif

#if ONDE_GROUPS
// Gathers light by the groups of its sources.
INLINE void gather_groups(natural group, real3 value, mask lanes, real3* sums) {
    for (uint g = 0; g < ONDE_GROUPS; g++)
        sums[g] = choose(lanes & (group == g), add3(sums[g], value), sums[g]);
}
#endif

// Tests the connections of a vertex, the camera or light being vertex 0, and adds what arrives.
INLINE void connect_lanes(Estimator e, FilmView film, Connection c, natural id, uint vertex,
                          mask lanes, Gathered* gathered) {
    const uint tested = mask_bits(lanes & (c.distance > 0.0f));
    if (!tested) return;
    count_rays(e.job.counters, COUNTER_SHADOW, vertex, popcount(tested));
#if ONDE_MEDIA // which are asked on all ways
    uint open = 0;
#else
    uint open = tested & ~trace_occluded(e.view.bvh, c.origin, c.direction, c.distance, tested);
#endif
#if ESTIMATOR_TRANSLUCENT
    const mask dim = mask_from_bits(tested & ~open);
    if_any (dim) {
    #if ESTIMATOR_WAYS
        const natural way = c.way;
    #else
        const natural way = (natural)(0u);
    #endif
        const real3 through =
            estimator_transmittance(e, c.origin, c.direction, c.distance, way, id, vertex, dim);
        c.value = choose(dim, mul3(c.value, through), c.value);
        open |= mask_bits(dim & nonzero3(through));
    }
#endif
#if ESTIMATOR_SPLATS
    add_splats(e, film, c, id, vertex, open, gathered);
#else
    const mask lit = mask_from_bits(open);
    gathered->sum = choose(lit, add3(gathered->sum, c.value), gathered->sum);
#endif
#if ONDE_TRAIL
    LightShares shares;
    shares.diffuse = c.diffuse;
    shares.transmitted = c.transmitted;
    gather_light(c.value, vertex + 1, shares, lit, &gathered->aovs);
#endif
#if ONDE_GROUPS
    gather_groups(c.target, c.value, lit, gathered->groups);
#endif
}

// What the paths from `first` gather, lanes at `end` and beyond left out.
INLINE Gathered trace_paths(Estimator e, FilmView film, uint first, uint end) {
    const mask lanes = group_lanes(first, end);
    const natural id = choose(lanes, lane_index() + first, (natural)(first));
    Gathered gathered;
    gathered.sum = zero3();
    gathered.contributed = gathered.unblocked = (natural)(0u);
#if ONDE_AOVS
    gathered.aovs = no_aovs();
#endif
#if ONDE_GROUPS
    for (uint g = 0; g < ONDE_GROUPS; g++) gathered.groups[g] = zero3();
#endif
    mask alive = lanes;
#if ESTIMATOR_CONNECTS_START
    const Step start = estimator_start(e, id, lanes);
    State state = start.next;
    alive = start.alive;
    connect_lanes(e, film, start.connection, id, 0, lanes, &gathered);
#else
    State state = estimator_start(e, id);
#endif
    for (uint bounce = 0; mask_bits(alive); bounce++) {
        const uint bits = mask_bits(alive);
        Hits hits = trace_bounce(e.view.bvh, state.origin, state.direction, bounce, bits);
#if ONDE_SEEN_THROUGH
        const mask may = may_pass(e.view, hits, state.direction, estimator_culls(state, alive),
                                  alive & (hits.primitive != BVH_NONE));
        if_any (may) hits = estimator_pass(e, state, hits, id, bounce, may);
#endif
#if ONDE_IDS
        if (bounce == 0) store_seen(e.job, id, hits.primitive, hits.instance, bits);
#endif
#if ESTIMATOR_TREE
        count_by_level(e.job.counters, COUNTER_EXTENSION, state.level, one_for(alive));
        const mask tree = alive;
        alive = follow_tree(e, &state, hits, id, tree);
        gathered.sum = choose(tree & !alive, state.color, gathered.sum);
#else
        count_rays(e.job.counters, COUNTER_EXTENSION, bounce, popcount(bits));
        const Step step = estimator_vertex(e, state, hits, id, bounce, alive);
    #if ESTIMATOR_EMITS
        gathered.sum = choose(alive, add3(gathered.sum, step.emitted), gathered.sum);
    #endif
    #if ONDE_AOVS
        if (bounce == 0) {
            gather_aovs(AOV_SOURCE_SURFACE, step.aovs, alive, &gathered.aovs);
            gather_aovs(AOV_SOURCE_RAY, step.aovs, alive, &gathered.aovs);
        }
    #endif
    #if ONDE_TRAIL
        gather_aovs(AOV_SOURCE_GUIDE, step.aovs, alive & step.guided, &gathered.aovs);
        gather_light(step.emitted, bounce, trail_shares(state), alive, &gathered.aovs);
    #endif
    #if ONDE_GROUPS
        gather_groups(step.group, grouped_emission(step), alive, gathered.groups);
        #if ONDE_GLOW
        gather_groups((natural)(0u), step.glow, alive, gathered.groups);
        #endif
    #endif
        state = step.next;
        connect_lanes(e, film, step.connection, id, bounce + ESTIMATOR_CONNECTS_START, alive,
                      &gathered);
        alive = step.alive;
#endif
    }
    return gathered;
}

#if !ESTIMATOR_SPLATS
    #if ONDE_AOVS || ONDE_GROUPS
// Of the lanes in `bits`, of shares of light as much as is kept of their samples.
INLINE void add_aov(Estimator e, FilmView film, real3 value, uint plane, bool is_light,
                    const float* kept, uint first, uint bits) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH];
    spill_real(x, value.x);
    spill_real(y, value.y);
    spill_real(z, value.z);
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        const float4 all = (float4)(x[k], y[k], z[k], 0.0f);
        film_add_aov(film, e.job, first + k, plane, is_light ? all * kept[k] : all);
    }
}
    #endif

// Adds the samples of the paths from `first`, those before `end`, and their AOVs.
INLINE void add_samples(Estimator e, FilmView film, Gathered gathered, uint first, uint end) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], kept[ONDE_WIDTH];
    spill_real(x, gathered.sum.x);
    spill_real(y, gathered.sum.y);
    spill_real(z, gathered.sum.z);
    uint added = 0;
    for (uint k = 0; k < ONDE_WIDTH && first + k < end; k++) {
        const float4 radiance = (float4)(x[k], y[k], z[k], 0.0f);
        kept[k] = kept_share(film, radiance);
        if (!film_add(film, e.job, first + k, radiance * kept[k])) continue;
        film_add_sample_aovs(film, e.job, first + k, STORED_AOVS, radiance, kept[k]);
        added |= 1u << k;
    }
    #if ONDE_AOVS
    uint plane = 0;
        #define ONDE_ADD_AOV(NAME, name, word, letters, SOURCE)                                    \
            if (AOV_SOURCE_##SOURCE != AOV_SOURCE_SAMPLE && HAS_AOV(NAME))                         \
                add_aov(e, film, gathered.aovs.name, ++plane,                                      \
                        AOV_SOURCE_##SOURCE == AOV_SOURCE_LIGHT, kept, first, added);
    AOVS(ONDE_ADD_AOV)
        #undef ONDE_ADD_AOV
    #endif
    #if ONDE_GROUPS
    for (uint g = 0; g < ONDE_GROUPS; g++)
        add_aov(e, film, gathered.groups[g], FILM_GROUPS + g, true, kept, first, added);
    #endif
}
#endif

__kernel void megakernel(LAUNCH_PARAMETERS, SCENE_PARAMETERS, JOB_PARAMETERS ESTIMATOR_PARAMETERS) {
    const Range range = whole_range(count, chunk);
    if (range.begin == range.end) return;
    ESTIMATOR(e);
    FILM_VIEW(film);
    for (uint i = range.begin; i < range.end; i += ONDE_WIDTH) {
        const Gathered gathered = trace_paths(e, film, i, range.end);
#if ESTIMATOR_SPLATS
        estimator_tell(e, sum_natural(gathered.contributed), sum_natural(gathered.unblocked));
#else
        add_samples(e, film, gathered, i, range.end);
#endif
    }
}
