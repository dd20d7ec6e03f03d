// What to render and how, once every default is filled in.
#pragma once

#include "core/enum_words.h"
#include "core/rectangle.h"
#include "gpu/settings.h"
#include "scene/scene.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace onde {

enum class Engine {
    wavefront,  ///< stages over queues of rays, staged or fused as the device settings say
    megakernel, ///< the whole path in one kernel
};

constexpr auto enum_words(Engine) {
    return std::array{EnumWord{Engine::wavefront, "wavefront"},
                      EnumWord{Engine::megakernel, "megakernel"}};
}

struct RenderOptions {
    uint32_t width = DEFAULT_FILM_SIZE.x, height = DEFAULT_FILM_SIZE.y; ///< each in [1, 65535]
    uint32_t samples = 64;                                              ///< per pixel, >= 1
    uint32_t first_sample = 0;    ///< of those, the ones to render: this one and all behind it
    uint32_t picture_samples = 0; ///< where others render more of them: the whole picture's; else 0
    std::optional<Rectangle> rectangle{}; ///< the only pixels that get samples
    double seconds = 0;                   ///< stop after about that long; 0: no limit
    /// By how much shown values may be off (render/noise.h), where `samples` is the most of a
    /// pixel, and the stops by which they are shown brighter; 0: all pixels get all samples.
    float noise = 0, noise_exposure = 0;
    uint32_t depth = 12;         ///< the most surfaces a path visits, in [1, 1023]
    uint32_t roulette_start = 1; ///< first bounce at which Russian roulette may end a path
    uint32_t seed = 0;
    Filter filter = Filter::blackman_harris;
    uint32_t camera = 0; ///< index into the scene's cameras
    IntegratorKind integrator = IntegratorKind::path;
    Engine engine = Engine::wavefront;
    Background background = Background::environment; ///< transparent: aovs has alpha
    float clamp = 0;   ///< the most radiance of a sample, whose aovs then has clamped; 0: any
    uint32_t aovs = 0; ///< that the film has beside radiance, by the bits of shared/aovs.h
    bool ids = false;  ///< whether the film counts what its samples see first
    std::vector<std::string> light_groups{}; ///< light_groups() of the scene if the film has the
                                             ///< light of each by itself, else empty
    gpu::DeviceSettings settings;
    uint32_t samples_in_flight = 16; ///< the most of one pixel in one wave; a power of two

    bool operator==(const RenderOptions&) const = default;
};

/// The largest depth that an integrator takes.
uint32_t most_depth(IntegratorKind integrator);

/// Whether its samples are each of one pixel.
bool follows_pixels(IntegratorKind integrator);

/// Throws InputError unless every value is in its range.
void check_options(const RenderOptions& options);

} // namespace onde
