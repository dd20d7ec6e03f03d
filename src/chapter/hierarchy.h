// What trees of boxes save (C13): the same rays through each of them, counted and timed.
#pragma once

#include "accel/bvh.h"
#include "chapter/triangle_soup.h"
#include "chapter/volume_tester.h"

namespace onde {

/// In the order in which they are shown.
inline constexpr std::array BUILDERS{BvhBuilder::none, BvhBuilder::median,
                                     BvhBuilder::median_spatial, BvhBuilder::sah, BvhBuilder::high};

/// For people.
const char* builder_name(BvhBuilder builder);

struct HierarchyReport {
    BvhStatistics tree;
    uint64_t rays = 0, hits = 0;
    uint64_t boxes = 0;     ///< tested, by all rays together; none where boxes exclude nothing
    uint64_t triangles = 0; ///< tested
    double seconds = 0;     ///< median of several runs

    double tests_per_hit() const { return hits ? double(boxes + triangles) / double(hits) : 0; }
    double ns_per_ray() const { return rays ? 1e9 * seconds / double(rays) : 0; }
};

HierarchyReport measure_hierarchy(gpu::Programs& programs, const TriangleSoup& object,
                                  BvhBuilder builder, std::span<const VolumeRay> rays);

} // namespace onde
