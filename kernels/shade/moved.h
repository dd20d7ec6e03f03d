// Where instances are that move while the shutter is open, lane by lane: each at its own moment.
#ifndef ONDE_SHADE_MOVED_H
#define ONDE_SHADE_MOVED_H

#include "shade/scene_view.h"

#if ONDE_SHUTTER

// As MovedInstance.
typedef struct {
    real3 to_object[3], object_offset;
    real3 to_world[3], world_offset;
} MovedRows;

INLINE real3 rows_times(const real3* rows, real3 v) {
    return make3(dot3(rows[0], v), dot3(rows[1], v), dot3(rows[2], v));
}

    #define MOVED_VECTORS 8 // of MovedRows, in its order

INLINE void spill_vector(float words[3][ONDE_WIDTH], uint k, float3 v) {
    words[0][k] = v.x;
    words[1][k] = v.y;
    words[2][k] = v.z;
}
INLINE real3 unspill_vector(const float words[3][ONDE_WIDTH]) {
    return make3(unspill_real(words[0]), unspill_real(words[1]), unspill_real(words[2]));
}

// Of the instances in `lanes`, all of which move; zeros in the other lanes. The arithmetic is that
// of rays which enter them.
INLINE MovedRows moved_rows(SceneView view, natural instance, mask lanes) {
    float words[MOVED_VECTORS][3][ONDE_WIDTH], index[ONDE_WIDTH], time[ONDE_WIDTH];
    for (uint i = 0; i < MOVED_VECTORS; i++)
        for (uint axis = 0; axis < 3; axis++) spill_real(words[i][axis], (real)(0.0f));
    spill_real(index, as_real(instance));
    spill_real(time, view.bvh.time);
    for (uint bits = mask_bits(lanes); bits; bits &= bits - 1) {
        const uint k = lowest_bit(bits);
        const MovedInstance moved = moved_instance(view.bvh.instances, as_uint(index[k]), time[k]);
        for (uint row = 0; row < 3; row++) {
            spill_vector(words[row], k, moved.to_object[row]);
            spill_vector(words[4 + row], k, moved.to_world[row]);
        }
        spill_vector(words[3], k, moved.object_offset);
        spill_vector(words[7], k, moved.world_offset);
    }
    MovedRows rows;
    for (uint row = 0; row < 3; row++) {
        rows.to_object[row] = unspill_vector(words[row]);
        rows.to_world[row] = unspill_vector(words[4 + row]);
    }
    rows.object_offset = unspill_vector(words[3]);
    rows.world_offset = unspill_vector(words[7]);
    return rows;
}

#endif

#endif
