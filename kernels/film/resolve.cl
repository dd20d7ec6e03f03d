// The kernel that writes the film from the sums of splats.
#include "film/job.h"
#include "shared/light_tracing.h"

INLINE float resolve_sum(__global const uint* words, float scale) {
    const float high = convert_float(words[2]) * 18446744073709551616.0f; // 2^64
    return (convert_float((ulong)words[1] << 32 | words[0]) + high) * scale;
}

// `count` pixels, `chunk` of them per work item. `scale` undoes the fixed point; `samples` is the
// number of emitted rays per pixel so far.
__kernel void resolve(uint count, uint chunk, __global const uint* splats,
                      __global float4* film_sums, float scale, float samples) {
    const Range range = whole_range(count, chunk);
    for (uint i = range.begin; i < range.end; i++) {
        __global const uint* words = splats + (size_t)i * SPLAT_WORDS;
        film_sums[i] = (float4)(resolve_sum(words, scale), resolve_sum(words + 3, scale),
                                resolve_sum(words + 6, scale), samples);
    }
}
