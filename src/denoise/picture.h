// What denoisers take and give: linear pictures of one size, as values.
#pragma once

#include "image/image.h"

#include <vector>

namespace onde {

struct NoisyPicture {
    Image radiance;              ///< 3 channels
    Image variance;              ///< of the radiance, which is a mean of samples; 3 channels
    Image albedo, normal, depth; ///< of what is seen, means of the same samples; 3, 3, 1 channels
    /// Parts of the radiance that are denoised with it, such as those of groups of lights.
    std::vector<Image> parts{};
};

struct DenoisedPicture {
    Image radiance;
    std::vector<Image> parts{}; ///< which add up to the radiance where they did before
};

} // namespace onde
