// The watertight option, counted: how many rays leave a closed mesh through its edges and corners.
#pragma once

#include "accel/bvh.h"
#include "chapter/volume_trials.h"
#include "gpu/program.h"

namespace onde {

/// A bumpy ball about the origin of 8 * 4^subdivisions triangles that share their corners, scaled
/// by `size` along each axis. It contains the box of half size 0.2 * size.
TriangleSoup closed_ball(uint32_t subdivisions, glm::vec3 size);

struct LeakTrials {
    uint64_t rays = 0, leaks = 0;
    double seconds = 0;
};

/// Shoots at least `rays` rays from inside closed_ball(subdivisions, size) at random points of its
/// edges, and at its corners, half and half. Any that hits nothing is a leak.
LeakTrials count_leaks(gpu::Programs& programs, uint32_t subdivisions, glm::vec3 size,
                       bool watertight, uint64_t rays);

} // namespace onde
