#include "image/image_io.h"
#include "scene/angle.h"
#include "scene/load.h"
#include "scene/load_context.h"
#include "scene/loaders.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace onde {

/// Grey becomes three equal channels; alpha is dropped; what is not a radiance becomes 0. Infinity
/// stays until bound_environment.
static Image as_radiance(const Image& image) {
    Image map(image.width, image.height, 3);
    const size_t pixels = size_t(image.width) * image.height;
    for (size_t i = 0; i < pixels; ++i)
        for (size_t c = 0; c < 3; ++c) {
            const float value = image.pixels[i * image.channels + (image.channels < 3 ? 0 : c)];
            map.pixels[i * 3 + c] = value > 0.0f ? value : 0.0f;
        }
    return map;
}

Environment load_environment(const std::filesystem::path& path, glm::vec3 scale,
                             float rotation_degrees, uint64_t max_pixels) {
    return {.radiance = scale,
            .map = as_radiance(read_image(path, max_pixels)),
            .rotation = radians_of(rotation_degrees)};
}

Environment load_environment_within(LoadContext& context, const std::filesystem::path& path,
                                    float rotation_degrees) {
    const std::string name = path.string(), file = read_file_within(context, path);
    const ImageSize size =
        image_size({reinterpret_cast<const uint8_t*>(file.data()), file.size()}, name);
    context.spend(size.pixels(), ENVIRONMENT_PIXEL_BYTES, name);
    return load_environment(path, glm::vec3(1.0f), rotation_degrees);
}

void bound_environment(Scene& scene) {
    if (!scene.environment.map) return;
    constexpr float LARGEST_HALF = 65504.0f; // beyond it files of half floats say infinity
    float largest = LARGEST_HALF;
    size_t infinite = 0;
    for (const float value : scene.environment.map->pixels)
        if (std::isfinite(value))
            largest = std::max(largest, value);
        else
            ++infinite;
    if (infinite == 0) return;
    for (float& value : scene.environment.map->pixels)
        if (!std::isfinite(value)) value = largest;
    scene.notes.push_back(fmt::format("{} infinite numbers of the environment's map were taken as "
                                      "{:g}.",
                                      infinite, largest));
}

} // namespace onde
