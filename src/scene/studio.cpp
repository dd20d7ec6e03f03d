// The light of scenes that bring none.
#include "scene/studio.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde {

/// A rectangular light with soft edges, in spherical coordinates about its centre.
struct Softbox {
    float azimuth, elevation; ///< of its centre, radians; azimuth 0 is -Z, pi/2 is +X
    float half_width, half_height, softness; ///< radians
    float radiance;
};

static float edge(float distance, float half_size, float softness) {
    const float t = std::clamp((half_size + softness - distance) / softness, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

static float radiance_toward(const Softbox& box, float azimuth, float elevation) {
    const float turn = std::remainder(azimuth - box.azimuth, 2.0f * std::numbers::pi_v<float>);
    return box.radiance * edge(std::abs(turn), box.half_width, box.softness) *
           edge(std::abs(elevation - box.elevation), box.half_height, box.softness);
}

Image studio_map() {
    constexpr float PI = std::numbers::pi_v<float>;
    // The framing camera stands toward +Z: behind it is azimuth pi, its left is -X.
    const Softbox boxes[] = {{-0.80f * PI, 0.75f, 0.40f, 0.30f, 0.25f, 3.3f},
                             {0.62f * PI, 0.35f, 0.45f, 0.45f, 0.40f, 0.45f},
                             {0.10f * PI, 0.85f, 0.60f, 0.12f, 0.20f, 1.6f}};
    Image map(64, 32, 3);
    for (uint32_t y = 0; y < map.height; ++y)
        for (uint32_t x = 0; x < map.width; ++x) {
            const float elevation = PI * (0.5f - (float(y) + 0.5f) / float(map.height));
            const float azimuth = 2.0f * PI * ((float(x) + 0.5f) / float(map.width) - 0.5f);
            float radiance = 0.27f + 0.20f * std::sin(elevation);
            for (const Softbox& box : boxes) radiance += radiance_toward(box, azimuth, elevation);
            std::ranges::fill(map.pixel(x, y), radiance);
        }
    return map;
}

} // namespace onde
