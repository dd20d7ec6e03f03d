// What a user asks of a render: what is absent follows from the scene, then from the device.
#pragma once

#include "accel/bvh.h"
#include "render/options.h"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace onde {

struct RenderChoices {
    std::optional<uint32_t> width, height; ///< pixels
    std::optional<uint32_t> samples, depth, seed;
    std::optional<double> seconds;
    std::optional<float> noise, exposure; ///< of RenderOptions; a noise of 0 is none
    /// The first of the picture's samples to render, and the one behind the last.
    std::optional<std::pair<uint32_t, uint32_t>> sample_range;
    std::optional<Rectangle> rectangle; ///< the only pixels that are rendered
    std::optional<IntegratorKind> integrator;
    std::optional<Filter> filter;
    std::string camera; ///< of the scene, by name or number; empty: the first
    std::optional<Background> background;
    std::optional<float> clamp;
    uint32_t aovs = 0; ///< of RenderOptions
    bool light_groups = false, ids = false;
    std::optional<Engine> engine;
    std::optional<gpu::Launch> launch;
    std::optional<bool> interleave;
    std::optional<uint32_t> lanes, wave_size, chunk;
};

struct ResolvedOptions {
    RenderOptions options;
    std::vector<std::string> notes; ///< what was chosen otherwise than asked, a sentence each
};

/// The choices over the scene's own settings over the device's. Throws InputError.
ResolvedOptions resolve_options(const RenderChoices& choices, const Scene& scene,
                                const gpu::DeviceFacts& facts);

/// Throws InputError unless films with these options have planes for the scene's groups of lights.
void check_light_groups(const Scene& scene, const RenderOptions& options);

/// How pictures of the scene are shown where the user asks for nothing else: as it says, else
/// without exposure, and by the neutral tone map; the chapter's integrators compute what a display
/// is to show.
Display display_of(const RenderSettings& scene, IntegratorKind integrator);

} // namespace onde
