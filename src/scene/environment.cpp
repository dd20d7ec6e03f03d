#include "image/image_io.h"
#include "scene/load.h"

#include <cmath>

namespace onde {

/// Grey becomes three equal channels; alpha is dropped; what is not a radiance becomes 0.
static Image as_radiance(const Image& image) {
    Image map(image.width, image.height, 3);
    const size_t pixels = size_t(image.width) * image.height;
    for (size_t i = 0; i < pixels; ++i)
        for (size_t c = 0; c < 3; ++c) {
            const float value = image.pixels[i * image.channels + (image.channels < 3 ? 0 : c)];
            map.pixels[i * 3 + c] = std::isfinite(value) && value > 0.0f ? value : 0.0f;
        }
    return map;
}

Environment load_environment(const std::filesystem::path& path, glm::vec3 scale,
                             float rotation_degrees) {
    return {.radiance = scale,
            .map = as_radiance(read_image(path)),
            .rotation = glm::radians(rotation_degrees)};
}

} // namespace onde
