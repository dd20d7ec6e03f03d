// The memory of a wave of paths. The text of an estimator, one of .../estimator.h, comes before the
// schedulers' in every program. It names the columns of a path's state and of its connections, and
// says what it needs of the schedulers:
//   ESTIMATOR_EMITS           vertices add to the path's sum themselves
//   ESTIMATOR_CONNECTS_START  a path has a connection before its first ray
//   ESTIMATOR_SPLATS          connections go to any pixel, not to the path's own sum
//   ESTIMATOR_TRANSLUCENT     what blocks a connection may let some of it through
//   ESTIMATOR_WAYS            connections say how they go, in their last column
//   (ONDE_SEEN_THROUGH: rays may go on behind what they hit; estimator_pass says which)
//   ESTIMATOR_TREE            vertices have several connections and children
//
// Bytes per path: the path tracer's 44 of state, 64 of work, 16 of its sum: 124. Staged launches
// keep a second copy of the state.
#ifndef ONDE_WAVEFRONT_WAVE_H
#define ONDE_WAVEFRONT_WAVE_H

#include "film/light_shares.h"
#include "trace/trace_columns.h"

COLUMNS_ACCESS(State, state, ESTIMATOR_COLUMNS)
COLUMNS_ACCESS(Connection, connection, ESTIMATOR_CONNECTIONS)

// Columns that move with a path: its state, and its index in the wave.
#define COLUMN_ID COLUMN_COUNT(ESTIMATOR_COLUMNS)
#define MOVED_COLUMNS (COLUMN_ID + 1)

// Columns that last from one stage to the next: whether the path goes on, its hit, its connection.
#define WORK_ALIVE 0
#define WORK_HITS 1
#define WORK_CONNECTION (WORK_HITS + COLUMN_COUNT(HIT_COLUMNS))

typedef struct {
    Columns state, work;
    __global float4* sums; // by path id: what the path has gathered; its AOVs behind, by planes
} WaveView;

// The same as kernel parameters, in the order in which the host binds them.
#define WAVE_PARAMETERS                                                                            \
    __global float *state, __global float *work, __global float4 *sums, uint stride

#define WAVE_VIEW(view) const WaveView view = {{state, stride}, {work, stride}, sums}

INLINE Columns wave_hits(WaveView wave) {
    return columns_from(wave.work, WORK_HITS);
}
INLINE Columns wave_connections(WaveView wave) {
    return columns_from(wave.work, WORK_CONNECTION);
}

INLINE natural load_id(WaveView wave, uint i) {
    return load_natural(column(wave.state, COLUMN_ID, i));
}
INLINE void store_id(WaveView wave, uint i, natural id) {
    store_natural(column(wave.state, COLUMN_ID, i), id);
}

INLINE mask load_alive(WaveView wave, uint i) {
    return load_natural(column(wave.work, WORK_ALIVE, i)) != 0u;
}
INLINE void store_alive(WaveView wave, uint i, mask alive) {
    store_natural(column(wave.work, WORK_ALIVE, i), one_for(alive));
}

// The first number of each sum, and all three: of estimators that read them back.
INLINE real load_sums(WaveView wave, natural id) {
    return gather_real((__global const float*)wave.sums, id * 4u);
}
INLINE void store_sums(WaveView wave, natural id, real3 value, uint bits) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], word[ONDE_WIDTH];
    spill_real(x, value.x);
    spill_real(y, value.y);
    spill_real(z, value.z);
    spill_real(word, as_real(id));
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        wave.sums[as_uint(word[k])] = (float4)(x[k], y[k], z[k], 0.0f);
    }
}

// Adds to the sums of the paths in `bits`. Every path is in one slot, so nobody else writes there.
INLINE void add_to_sums(WaveView wave, natural id, real3 value, uint bits) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], word[ONDE_WIDTH];
    spill_real(x, value.x);
    spill_real(y, value.y);
    spill_real(z, value.z);
    spill_real(word, as_real(id));
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        wave.sums[as_uint(word[k])] += (float4)(x[k], y[k], z[k], 0.0f);
    }
}

#if ONDE_GROUPS
// The same of the groups of lights that the values come from.
INLINE void add_to_groups(WaveView wave, natural id, natural group, real3 value, uint bits) {
    add_to_sums(wave, (group + WAVE_GROUPS) * wave.state.stride + id, value, bits);
}
#endif

#if ONDE_AOVS
    // Calls WRITE(plane's first sum + id, AOV) for each AOV of a source that the program has.
    #define ONDE_WRITE_AOV(NAME, name, word, letters, SOURCE)                                      \
        if (AOV_SOURCE_##SOURCE != AOV_SOURCE_SAMPLE && HAS_AOV(NAME)) {                           \
            id += wave.state.stride;                                                               \
            if (AOV_SOURCE_##SOURCE == source) WRITE_SUMS(wave, id, all.name, bits);               \
        }

// What the paths in `bits` have of every AOV of a source.
INLINE void store_aovs(WaveView wave, natural id, uint source, Aovs all, uint bits) {
    #define WRITE_SUMS store_sums
    AOVS(ONDE_WRITE_AOV)
    #undef WRITE_SUMS
}
    #if ONDE_TRAIL
// Adds light that `surfaces` surfaces have turned to the AOVs of light.
INLINE void add_light(WaveView wave, natural id, real3 value, uint surfaces, LightShares shares,
                      uint bits) {
    const uint source = AOV_SOURCE_LIGHT;
    const Aovs all = light_aovs(value, surfaces, shares);
        #define WRITE_SUMS add_to_sums
    AOVS(ONDE_WRITE_AOV)
        #undef WRITE_SUMS
}
    #endif
#endif

#endif
