// Where things are at the next frame, of scenes that are packed with it. Kernels know of it where
// ONDE_MOTION is 1; the frame's record of the next camera is then the second one.
#ifndef ONDE_SHARED_MOTION_H
#define ONDE_SHARED_MOTION_H

#include "shared/types.h"

// How a thing moves to the next frame: the place of a point of the world changes by step times
// (x, y, z, 1), and that of a triangle that deforms by the mean of its corners' own steps too.
typedef struct {
    float step[12];      // rows of a 3x4 matrix
    float to_world[9];   // rows, of the corners' steps
    uint deforms;        // whether corners have steps
    uint first_triangle; // plus the primitive, modulo 2^32: its place among the corners' steps
    uint unused;
} MoverRecord;

// As SCENE_BUFFERS in shared/scene.h. The first mover stands still. corner_steps: three vectors a
// triangle.
#define MOTION_BUFFERS(BUFFER)                                                                     \
    BUFFER(MoverRecord, movers, "movers")                                                          \
    BUFFER(uint, instance_movers, "movers of BVH instances")                                       \
    BUFFER(uint, primitive_movers, "movers of primitives without one")                             \
    BUFFER(float, corner_steps, "steps of corners")

#endif
