// The laboratory's experiment on one object: every bounding volume and every hierarchy under the
// same random lines.
#pragma once

#include "chapter/hierarchy.h"
#include "chapter/volume_trials.h"

namespace onde {

struct VolumeReport {
    VolumeKind kind = VolumeKind::box;
    VolumeMeasure size;
    uint64_t rejected = 0;    ///< of the rays
    double tests_per_hit = 0; ///< of the volume, then of all triangles where it is met
    double ns_per_test = 0;
};

struct LabReport {
    size_t triangles = 0;
    uint64_t rays = 0, hits = 0;
    uint64_t flat_rays = 0; ///< of them, those that went through the list without a hierarchy
    std::vector<VolumeReport> volumes{};
    std::vector<HierarchyReport> hierarchies{}; ///< in the order of BUILDERS
};

/// `rays` lines that meet a ball of 1.5 times the radius of the object's smallest sphere.
LabReport run_laboratory(gpu::Programs& programs, const TriangleSoup& object,
                         const FittedVolumes& volumes, VolumeTester& tester, uint32_t rays);

} // namespace onde
