// The ray sets of the traversal bench: what a path tracer would ask, recorded once and shared by
// all contenders.
#pragma once

#include "model.h"
#include "upload/ray_query.h"

namespace onde::bench {

using Ray = QueryRay;
using Hit = QueryHit;

struct RaySet {
    std::string name;
    bool any_hit = false;
    std::vector<Ray> rays{};
};

class EmbreeScene;

/// Five sets from pictures of side x side pixels, 4 samples each, in tiles of 8 x 8:
///   primary  through the pixels, from a pinhole
///   shadow   from what they hit to a jittered point near the light (any hit)
///   ao       from there, cosine-distributed, a twentieth of the extent long (any hit)
///   bounce   from there, cosine-distributed: the first diffuse bounce
///   bounce3  the third
/// Rays that would start where nothing was hit are left out. The rays of as many pictures, with
/// other samples, follow each other until a set has half as many rays as primary, or of 64 where
/// little is hit; a set may be empty.
std::vector<RaySet> record_rays(const Model& model, const EmbreeScene& oracle, uint32_t side);

} // namespace onde::bench
