// The binary counter of a film's blocks, all planes and levels alike; see src/render/film.h for the
// tree in which the host calls it. `count` pixels, `chunk` of them per work item.
#include "film/job.h"

// Joins the block with as many samples that lie before it.
__kernel void join(uint count, uint chunk, __global const float4* pending, __global float4* block) {
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) block[i] = pending[i] + block[i];
}

// Puts the block aside, and starts the next one from zero.
__kernel void carry(uint count, uint chunk, __global float4* pending, __global float4* block) {
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) {
        pending[i] = block[i];
        block[i] = (float4)(0.0f);
    }
}
