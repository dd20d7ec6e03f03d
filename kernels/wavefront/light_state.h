// Light paths in flight: lanes of one word per slot, LIGHT_LANES (56 bytes) per path.
#ifndef ONDE_WAVEFRONT_LIGHT_STATE_H
#define ONDE_WAVEFRONT_LIGHT_STATE_H

#include "light_tracing/light_tracing.h"
#include "wavefront/state.h"

#define LIGHT_LANE_ORIGIN 0
#define LIGHT_LANE_DIRECTION 3
#define LIGHT_LANE_EMITTED 6
#define LIGHT_LANE_THROUGHPUT 9
#define LIGHT_LANE_ID 12          // index of the path in its wave
#define LIGHT_LANE_CONTRIBUTED 13 // 0, or 1 when it has added to some pixel

typedef struct {
    LightPath path;
    natural id;
    mask contributed;
} LightSlots;

typedef struct {
    __global float* state; // lane k of slot i is at k * stride + i
    uint stride;
} LightState;

INLINE LightSlots load_light(LightState s, uint i) {
    LightSlots slots;
    slots.path.origin = load3(s.state, s.stride, LIGHT_LANE_ORIGIN, i);
    slots.path.direction = load3(s.state, s.stride, LIGHT_LANE_DIRECTION, i);
    slots.path.emitted = load3(s.state, s.stride, LIGHT_LANE_EMITTED, i);
    slots.path.throughput = load3(s.state, s.stride, LIGHT_LANE_THROUGHPUT, i);
    slots.id = load_natural(lane(s.state, s.stride, LIGHT_LANE_ID, i));
    slots.contributed = load_natural(lane(s.state, s.stride, LIGHT_LANE_CONTRIBUTED, i)) != 0u;
    return slots;
}

INLINE void append3(LightState s, uint k, uint i, real3 a, uint bits) {
    compress_real(lane(s.state, s.stride, k, i), a.x, bits);
    compress_real(lane(s.state, s.stride, k + 1, i), a.y, bits);
    compress_real(lane(s.state, s.stride, k + 2, i), a.z, bits);
}

// Puts the paths in `bits` into consecutive slots from i; returns the slot after them.
INLINE uint append_light(LightState s, uint i, LightSlots slots, uint bits) {
    append3(s, LIGHT_LANE_ORIGIN, i, slots.path.origin, bits);
    append3(s, LIGHT_LANE_DIRECTION, i, slots.path.direction, bits);
    append3(s, LIGHT_LANE_EMITTED, i, slots.path.emitted, bits);
    append3(s, LIGHT_LANE_THROUGHPUT, i, slots.path.throughput, bits);
    compress_real(lane(s.state, s.stride, LIGHT_LANE_ID, i), as_real(slots.id), bits);
    const natural flag = choose(slots.contributed, (natural)(1u), (natural)(0u));
    compress_real(lane(s.state, s.stride, LIGHT_LANE_CONTRIBUTED, i), as_real(flag), bits);
    return i + popcount(bits);
}

#endif
