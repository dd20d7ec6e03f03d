// What light tracing keeps beside the film: sums of splats as 96-bit integers of three words, and
// statistics as 64-bit integers of two words, low first. Adding integers in any order gives the
// same bits.
#ifndef ONDE_SHARED_LIGHT_TRACING_H
#define ONDE_SHARED_LIGHT_TRACING_H

#include "shared/types.h"

#define SPLAT_WORDS 9 // of a pixel: red, green, blue

// Places in the statistics, in sums.
#define LIGHT_CONTRIBUTED 0u // emitted rays that met a surface which then added to some pixel
#define LIGHT_UNBLOCKED 1u   // connections with nothing in between
#define LIGHT_STATISTICS 2u

// 32 bytes: what is the same for every emitted ray of a frame.
typedef struct {
    float center[3]; // of a sphere around the scene, which light from infinity is aimed at
    float radius;
    float splat_scale; // of a splat's fixed point: a power of two
    float unused[3];
} LightTracingRecord;

#endif
