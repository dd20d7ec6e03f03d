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

INLINE float3 word3(Columns c, uint k, uint i) {
    return (float3)(*column(c, k, i), *column(c, k + 1, i), *column(c, k + 2, i));
}

// The connection of a slot, which something opaque or translucent may block. vertex: of the path,
// the camera or light being 0.
INLINE void deliver(Estimator e, WaveView wave, FilmView film, uint slot, uint vertex,
                    uint blocked) {
    const Columns connections = wave_connections(wave);
    float transmittance = 1.0f;
    if (blocked) {
#if ESTIMATOR_TRANSLUCENT
        transmittance = estimator_transmittance(e, word3(connections, 0, slot),
                                                word3(connections, RAY_DIRECTION, slot),
                                                *column(connections, RAY_DISTANCE, slot));
        if (!(transmittance > 0.0f)) return;
#else
        return;
#endif
    }
    const uint path = as_uint(*column(wave.state, COLUMN_ID, slot));
    const float3 value = word3(connections, RAY_DISTANCE + 1, slot) * transmittance;
#if ESTIMATOR_SPLATS
    const uint target = as_uint(*column(connections, RAY_DISTANCE + 4, slot));
    wave.sums[path] += estimator_splat(e, film, path, vertex, target, value);
#else
    wave.sums[path] += (float4)(value, 0.0f);
#endif
}

#endif
