// The state of a wave in memory: lanes of one word per slot, behind load and store functions.
//
// Bytes per path: 17 lanes of state (68), 10 of its shadow ray (40), radiance (16): 124.
// Global queues keep a second copy of the first 11 lanes and their liveness.
#ifndef ONDE_WAVEFRONT_STATE_H
#define ONDE_WAVEFRONT_STATE_H

#include "path/path.h"
#include "trace/trace_rows.h"

#define LANE_ORIGIN 0
#define LANE_PDF 3
#define LANE_DIRECTION 4
#define LANE_ID 7 // index of the path in its wave, where its radiance goes
#define LANE_THROUGHPUT 8
#define LANE_ALIVE 11 // 0, or 1 when the path goes on
#define PATH_LANES 11 // what moves when a path moves
#define LANE_HIT 12   // t, u, v, primitive, instance
#define STATE_LANES 17

#define LANE_SHADOW_ORIGIN 0
#define LANE_SHADOW_DISTANCE 3 // 0: no shadow ray
#define LANE_SHADOW_DIRECTION 4
#define LANE_SHADOW_RADIANCE 7
#define SHADOW_LANES 10

// A wave's memory. Lane k of slot i is at k * stride + i.
typedef struct {
    __global float* state;
    __global float* shadow;
    __global float4* radiance; // by path id
    uint stride;
} WaveView;

INLINE __global float* lane(__global float* lanes, uint stride, uint k, uint i) {
    return lanes + (size_t)k * stride + i;
}

INLINE real3 load3(__global float* lanes, uint stride, uint k, uint i) {
    return make3(load_real(lane(lanes, stride, k, i)), load_real(lane(lanes, stride, k + 1, i)),
                 load_real(lane(lanes, stride, k + 2, i)));
}
INLINE void store3(__global float* lanes, uint stride, uint k, uint i, real3 a) {
    store_real(lane(lanes, stride, k, i), a.x);
    store_real(lane(lanes, stride, k + 1, i), a.y);
    store_real(lane(lanes, stride, k + 2, i), a.z);
}

INLINE Path load_path(WaveView wave, uint i) {
    Path path;
    path.origin = load3(wave.state, wave.stride, LANE_ORIGIN, i);
    path.pdf = load_real(lane(wave.state, wave.stride, LANE_PDF, i));
    path.direction = load3(wave.state, wave.stride, LANE_DIRECTION, i);
    path.throughput = load3(wave.state, wave.stride, LANE_THROUGHPUT, i);
    return path;
}
INLINE void store_path(WaveView wave, uint i, Path path) {
    store3(wave.state, wave.stride, LANE_ORIGIN, i, path.origin);
    store_real(lane(wave.state, wave.stride, LANE_PDF, i), path.pdf);
    store3(wave.state, wave.stride, LANE_DIRECTION, i, path.direction);
    store3(wave.state, wave.stride, LANE_THROUGHPUT, i, path.throughput);
}

INLINE natural load_path_id(WaveView wave, uint i) {
    return load_natural(lane(wave.state, wave.stride, LANE_ID, i));
}
INLINE void store_path_id(WaveView wave, uint i, natural id) {
    store_natural(lane(wave.state, wave.stride, LANE_ID, i), id);
}

INLINE mask load_alive(WaveView wave, uint i) {
    return load_natural(lane(wave.state, wave.stride, LANE_ALIVE, i)) != 0u;
}
INLINE void store_alive(WaveView wave, uint i, mask alive) {
    store_natural(lane(wave.state, wave.stride, LANE_ALIVE, i),
                  choose(alive, (natural)(1u), (natural)(0u)));
}

// Where the rays of the paths lie, and the hits that these find.
INLINE RayRows path_ray_rows(WaveView wave) {
    const RayRows rows = {lane(wave.state, wave.stride, LANE_ORIGIN, 0),
                          lane(wave.state, wave.stride, LANE_DIRECTION, 0), wave.stride};
    return rows;
}
INLINE HitRows path_hit_rows(WaveView wave) {
    const HitRows rows = {lane(wave.state, wave.stride, LANE_HIT, 0), wave.stride};
    return rows;
}
INLINE RayRows shadow_ray_rows(WaveView wave) {
    const RayRows rows = {lane(wave.shadow, wave.stride, LANE_SHADOW_ORIGIN, 0),
                          lane(wave.shadow, wave.stride, LANE_SHADOW_DIRECTION, 0), wave.stride};
    return rows;
}

INLINE ShadowRay load_shadow_ray(WaveView wave, uint i) {
    ShadowRay ray;
    ray.origin = load3(wave.shadow, wave.stride, LANE_SHADOW_ORIGIN, i);
    ray.distance = load_real(lane(wave.shadow, wave.stride, LANE_SHADOW_DISTANCE, i));
    ray.direction = load3(wave.shadow, wave.stride, LANE_SHADOW_DIRECTION, i);
    ray.radiance = load3(wave.shadow, wave.stride, LANE_SHADOW_RADIANCE, i);
    return ray;
}
INLINE void store_shadow_ray(WaveView wave, uint i, ShadowRay ray) {
    store3(wave.shadow, wave.stride, LANE_SHADOW_ORIGIN, i, ray.origin);
    store_real(lane(wave.shadow, wave.stride, LANE_SHADOW_DISTANCE, i), ray.distance);
    store3(wave.shadow, wave.stride, LANE_SHADOW_DIRECTION, i, ray.direction);
    store3(wave.shadow, wave.stride, LANE_SHADOW_RADIANCE, i, ray.radiance);
}

// Adds to the radiance of the paths in `bits`. Every path is in one slot, so nobody else writes
// there.
INLINE void add_radiance(WaveView wave, natural id, real3 radiance, uint bits) {
    float x[ONDE_WIDTH], y[ONDE_WIDTH], z[ONDE_WIDTH], word[ONDE_WIDTH];
    spill_real(x, radiance.x);
    spill_real(y, radiance.y);
    spill_real(z, radiance.z);
    spill_real(word, as_real(id));
    for (; bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        wave.radiance[as_uint(word[k])] += (float4)(x[k], y[k], z[k], 0.0f);
    }
}

// Moves the paths in `bits` of the group at slot i of `from` to consecutive slots from j of `to`.
INLINE void move_paths(WaveView from, uint i, WaveView to, uint j, uint bits) {
    for (uint k = 0; k < PATH_LANES; k++) {
        const real words = load_real(lane(from.state, from.stride, k, i));
        compress_real(lane(to.state, to.stride, k, j), words, bits);
    }
}

#endif
