#include "render/options.h"

#include "core/error.h"
#include "render/film_nodes.h"
#include "shared/aovs.h"
#include "shared/frame.h"
#include "shared/whitted.h"

#include <bit>
#include <cmath>

namespace onde {

static void check_range(const char* name, uint64_t value, uint64_t low, uint64_t high) {
    if (value < low || value > high)
        throw InputError("{} {} is out of range; use {} to {}", name, value, low, high);
}

uint32_t most_depth(IntegratorKind integrator) {
    return integrator == IntegratorKind::whitted ? MAX_TREE_DEPTH : COUNTER_BOUNCES - 1;
}

static void check_film(const RenderOptions& options) {
    const bool transparent = options.background == Background::transparent;
    if (options.integrator != IntegratorKind::path && options.clamp > 0)
        throw InputError("--clamp is for --integrator path, not for {}",
                         word_of(options.integrator));
    const bool has_channels = options.aovs != 0 || options.ids || !options.light_groups.empty();
    if (options.integrator != IntegratorKind::path && (transparent || has_channels))
        throw InputError(
            "--background transparent and the --aov of surfaces, light and ids are for "
            "--integrator path, not for {}",
            word_of(options.integrator));
    if (options.aovs >> AOV_COUNT)
        throw InputError("the AOVs {:#x} have bits that are none", options.aovs);
    if (transparent && !(options.aovs >> AOV_ALPHA & 1))
        throw InputError("a transparent background needs the AOV alpha");
    const bool has_clamped = (options.aovs >> AOV_CLAMPED & 1) != 0;
    if (has_clamped != (options.clamp > 0))
        throw InputError("the channel clamped is what --clamp removes; give --clamp too");
}

/// Half of a step of 8 bits, squared by the shown values' root, takes no more.
constexpr float LEAST_NOISE = 1e-4f;

static void check_noise(const RenderOptions& options) {
    if (options.noise == 0) return;
    if (!(options.noise >= LEAST_NOISE && options.noise <= 1))
        throw InputError("noise {} is out of range; use {} to 1", options.noise, LEAST_NOISE);
    if (!std::isfinite(options.noise_exposure))
        throw InputError("the exposure {} is not a number of stops", options.noise_exposure);
    if (options.integrator != IntegratorKind::path)
        throw InputError("--noise is for --integrator path, not for {}",
                         word_of(options.integrator));
    if (!(options.aovs >> AOV_HALVES & 1))
        throw InputError("a film with a noise target needs the AOV error");
    if (options.first_sample > 0)
        throw InputError(
            "--noise decides from all samples of a picture which ones follow; it can't "
            "be had of those from {} on",
            options.first_sample);
}

static void check_rectangle(const RenderOptions& options) {
    if (!options.rectangle) return;
    const Rectangle& r = *options.rectangle;
    if (r.pixels() == 0 || uint64_t(r.x) + r.width > options.width ||
        uint64_t(r.y) + r.height > options.height)
        throw InputError("the rectangle {},{} of {}x{} pixels does not lie in the picture of {}x{}",
                         r.x, r.y, r.width, r.height, options.width, options.height);
    if (!follows_pixels(options.integrator))
        throw InputError("--integrator {} draws all pixels at once; a rectangle of them is for "
                         "path and whitted",
                         word_of(options.integrator));
}

bool follows_pixels(IntegratorKind integrator) {
    return integrator == IntegratorKind::path || integrator == IntegratorKind::whitted;
}

void check_options(const RenderOptions& options) {
    check_range("width", options.width, 1, 65535);
    check_range("height", options.height, 1, 65535);
    check_range("width x height", uint64_t(options.width) * options.height, 1, 1u << 28);
    check_range("samples per pixel", options.samples, 1, 1u << 24);
    check_range("first sample", options.first_sample, 0, options.samples - 1);
    if (options.first_sample % FILM_BLOCK != 0)
        throw InputError("the first sample {} is not a multiple of {}", options.first_sample,
                         FILM_BLOCK);
    const bool is_whitted = options.integrator == IntegratorKind::whitted;
    check_range(is_whitted ? "depth of --integrator whitted" : "depth", options.depth, 1,
                most_depth(options.integrator));
    check_noise(options);
    check_film(options);
    check_rectangle(options);
    const gpu::DeviceSettings& s = options.settings;
    if (s.width != 1 && s.width != 8 && s.width != 16)
        throw InputError("width {} of lanes is not one of 1, 8, 16", s.width);
    check_range("wave size", s.wave_size, s.width, 1u << 26);
    check_range("chunk", s.chunk, s.width, s.wave_size);
    if (s.chunk % s.width || !std::has_single_bit(s.chunk))
        throw InputError("chunk {} is not a power of two that {} divides", s.chunk, s.width);
    if (s.wave_size % s.chunk)
        throw InputError("wave size {} is not a multiple of the chunk, {}", s.wave_size, s.chunk);
}

} // namespace onde
