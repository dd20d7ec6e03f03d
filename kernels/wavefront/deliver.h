// Where connections and paths end: what arrives goes to the path's own sum, or to any pixel. And
// the statistics of rays: by bounce, or by level where a path is a tree.
#ifndef ONDE_WAVEFRONT_DELIVER_H
#define ONDE_WAVEFRONT_DELIVER_H

#include "film/film.h"
#include "wavefront/wave.h"

INLINE void count_path_rays(WaveJob job, uint row, uint bounce, uint rays) {
#if !ESTIMATOR_TREE
    count_rays(job.counters, row, bounce, rays);
#endif
}

INLINE void count_tree_rays(WaveJob job, uint row, WaveView wave, uint i, mask lanes) {
#if ESTIMATOR_TREE
    count_by_level(job.counters, row, load_state(wave.state, i).level, one_for(lanes));
#endif
}

#define CONNECTION_TARGET COLUMN_COUNT(CONNECTION_COLUMNS)
#define CONNECTION_WAY (COLUMN_COUNT(ESTIMATOR_CONNECTIONS) - 1)

INLINE float3 word3(Columns c, uint k, uint i) {
    return (float3)(*column(c, k, i), *column(c, k + 1, i), *column(c, k + 2, i));
}

#if ESTIMATOR_TRANSLUCENT
// How much comes through of the connections in `blocked`, by their place among the slots. Returns
// those of which nothing does.
INLINE uint find_transmittance(Estimator e, WaveView wave, const uint* slots, uint blocked,
                               uint vertex, float3* transmittance) {
    const Columns connections = wave_connections(wave);
    float words[RAY_DISTANCE + 1][ONDE_WIDTH];
    uint place[ONDE_WIDTH], dark = 0;
    while (blocked) {
        uint count = 0;
        for (; blocked && count < ONDE_WIDTH; blocked &= blocked - 1)
            place[count++] = lowest_bit(blocked);
        for (uint k = 0; k <= RAY_DISTANCE; k++)
            for (uint i = 0; i < ONDE_WIDTH; i++)
                words[k][i] = *column(connections, k, slots[place[min(i, count - 1)]]);
        const real3 origin =
            make3(unspill_real(words[0]), unspill_real(words[1]), unspill_real(words[2]));
        const real3 direction =
            make3(unspill_real(words[3]), unspill_real(words[4]), unspill_real(words[5]));
        natural way = (natural)(0u);
    #if ESTIMATOR_WAYS
        float ways[ONDE_WIDTH];
        for (uint i = 0; i < ONDE_WIDTH; i++)
            ways[i] = *column(connections, CONNECTION_WAY, slots[place[min(i, count - 1)]]);
        way = as_natural(unspill_real(ways));
    #endif
        natural id = (natural)(0u);
    #if ONDE_GRIDS
        float ids[ONDE_WIDTH];
        for (uint i = 0; i < ONDE_WIDTH; i++)
            ids[i] = *column(wave.state, COLUMN_ID, slots[place[min(i, count - 1)]]);
        id = as_natural(unspill_real(ids));
    #endif
        const real3 through =
            estimator_transmittance(e, origin, direction, unspill_real(words[RAY_DISTANCE]), way,
                                    id, vertex, lane_index() < count);
        float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH];
        spill_real(x, through.x);
        spill_real(y, through.y);
        spill_real(z, through.z);
        for (uint i = 0; i < count; i++) {
            transmittance[place[i]] = (float3)(x[i], y[i], z[i]);
            if (!(x[i] > 0.0f || y[i] > 0.0f || z[i] > 0.0f)) dark |= 1u << place[i];
        }
    }
    return dark;
}
#endif

#if ONDE_TRAIL
// The same light to the AOVs of light.
INLINE void deliver_light(WaveView wave, uint slot, uint path, uint vertex, float3 value) {
    const Columns connections = wave_connections(wave);
    const uint shares = CONNECTION_TARGET + COLUMN_COUNT(PATH_TARGET);
    const float3 diffuse = word3(connections, shares, slot);
    const float transmitted = *column(connections, shares + 3, slot);
    #define ONDE_DELIVER_AOV(NAME, name, word, letters, SOURCE)                                    \
        if (AOV_SOURCE_##SOURCE != AOV_SOURCE_SAMPLE && HAS_AOV(NAME)) {                           \
            path += wave.state.stride;                                                             \
            if (AOV_SOURCE_##SOURCE == AOV_SOURCE_LIGHT)                                           \
                wave.sums[path] +=                                                                 \
                    (float4)(light_aov(AOV_##NAME, value, vertex + 1, diffuse, transmitted),       \
                             0.0f);                                                                \
        }
    AOVS(ONDE_DELIVER_AOV)
    #undef ONDE_DELIVER_AOV
}
#endif

// The connection of a slot, of which `transmittance` arrives. vertex: of the path, the camera or
// light being 0.
INLINE void deliver(Estimator e, WaveView wave, FilmView film, uint slot, uint vertex,
                    float3 transmittance) {
    const Columns connections = wave_connections(wave);
    const uint path = as_uint(*column(wave.state, COLUMN_ID, slot));
    const float3 value = word3(connections, RAY_DISTANCE + 1, slot) * transmittance;
#if ESTIMATOR_SPLATS
    const uint target = as_uint(*column(connections, CONNECTION_TARGET, slot));
    wave.sums[path] += estimator_splat(e, film, path, vertex, target, value);
#else
    wave.sums[path] += (float4)(value, 0.0f);
#endif
#if ONDE_TRAIL
    deliver_light(wave, slot, path, vertex, value);
#endif
#if ONDE_GROUPS
    const uint group = as_uint(*column(connections, CONNECTION_TARGET, slot));
    wave.sums[(WAVE_GROUPS + group) * wave.state.stride + path] += (float4)(value, 0.0f);
#endif
}

#endif
