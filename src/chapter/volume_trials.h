// The property that makes a volume a bounding one: no ray that hits the object is rejected.
#pragma once

#include "chapter/triangle_soup.h"
#include "chapter/volume_tester.h"

namespace onde {

struct VolumeTrials {
    uint64_t rays = 0;
    uint64_t hits = 0; ///< of the triangle aimed at, in double precision
    std::array<uint64_t, VOLUME_KINDS.size()> wrongly_rejected{};
    VolumeRay worst; ///< the last ray that was, if any
};

/// Rays aimed at triangles, edges and corners, from inside, from near and from a thousand extents
/// away, some along an axis: all a pure function of their number and `seed`. Whether a ray hits the
/// triangle it was aimed at is decided in double precision.
VolumeTrials try_volumes(const gpu::Device& device, VolumeTester& tester,
                         const TriangleSoup& object, uint64_t rays, uint64_t seed);

} // namespace onde
