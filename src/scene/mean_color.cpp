#include "scene/mean_color.h"

#include "image/tone.h"

#include <algorithm>

namespace onde {

glm::vec3 mean_color(const Scene& scene, int32_t texture) {
    const Texture& use = scene.textures[size_t(texture)];
    const ByteImage& image = image_of(scene.textures, use);
    glm::dvec3 sum(0.0);
    for (size_t i = 0; i < image.rgba.size(); i += 4)
        for (size_t c = 0; c < 3; ++c) {
            const float stored = float(image.wide(i + c)) / 65535.0f;
            sum[glm::length_t(c)] += use.srgb ? linear_from_srgb(stored) : stored;
        }
    return glm::vec3(sum / double(std::max<size_t>(image.rgba.size() / 4, 1)));
}

} // namespace onde
