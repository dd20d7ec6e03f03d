// A picture against the recursion, pixel by pixel.
#pragma once

#include "image/image.h"
#include "scene/scene.h"

#include <string>

namespace onde::chapter {

struct PictureCheck {
    size_t pixels = 0;
    double worst = 0;        ///< of all pixels that are not on a silhouette
    std::string worst_pixel; ///< where that is, with both colours
    size_t silhouettes = 0; ///< pixels beyond the tolerance, with an edge within a hundredth of one
    size_t wrong = 0;       ///< pixels beyond the tolerance without

    double silhouette_share() const { return double(silhouettes) / double(pixels); }
};

/// Compares each pixel of `picture`, made with that many samples and that depth, with the
/// recursion. A difference is that of the largest channel, over the recursion's where this is above
/// 1. A pixel on a silhouette sees another structure (see Seen) from up to a hundredth of a pixel
/// away.
PictureCheck check_picture(const Image& picture, const Scene& scene, uint32_t samples,
                           uint32_t depth, double tolerance);

} // namespace onde::chapter
