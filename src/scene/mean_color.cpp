#include "scene/mean_color.h"

#include "image/tone.h"

#include <algorithm>

namespace onde {

glm::vec3 mean_color(const Scene& scene, int32_t texture) {
    const Texture& use = scene.textures[size_t(texture)];
    const TexelImage& image = image_of(scene.textures, use);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < image.samples(); i += 4)
        for (size_t c = 0; c < 3; ++c)
            sum[glm::length_t(c)] += linear_sample(image, i + c, use.srgb);
    return glm::vec3(sum / double(std::max<size_t>(image.samples() / 4, 1)));
}

} // namespace onde
