#include "session/choices.h"

#include "core/error.h"
#include "render/film_nodes.h"
#include "render/frame.h"
#include "scene/light_groups.h"

#include "shared/aovs.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace onde {
namespace {

/// Samples of a render that is limited by its time alone.
constexpr uint32_t ENDLESS = 1u << 20;

/// The most samples of a pixel of a render that is limited by its noise alone.
constexpr uint32_t MOST_FOR_NOISE = 1u << 16;

/// Ray trees branch at every level.
constexpr uint32_t WHITTED_DEPTH = 8;

uint32_t find_camera(const std::string& name, const Scene& scene) {
    if (name.empty()) return 0;
    std::vector<std::string> names;
    for (uint32_t i = 0; i < scene.cameras.size(); i++) {
        if (scene.cameras[i].name == name || std::to_string(i) == name) return i;
        names.push_back(fmt::format("{} \"{}\"", i, scene.cameras[i].name));
    }
    throw InputError("--camera {}: no such camera; the scene has {}", name, fmt::join(names, ", "));
}

/// The depth that is chosen, or the scene's as far as an integrator that it does not ask for takes
/// it.
void resolve_depth(const RenderChoices& choices, const RenderSettings& own,
                   ResolvedOptions& resolved) {
    RenderOptions& options = resolved.options;
    if (options.integrator == IntegratorKind::whitted) options.depth = WHITTED_DEPTH;
    options.depth = choices.depth.value_or(own.depth.value_or(options.depth));
    const uint32_t most = most_depth(options.integrator);
    const bool is_own = options.integrator == own.integrator.value_or(IntegratorKind::path);
    if (choices.depth || is_own || options.depth <= most) return;
    resolved.notes.push_back(
        fmt::format("the scene's depth of {} was cut to {}, the most that --integrator {} takes",
                    options.depth, most, word_of(options.integrator)));
    options.depth = most;
}

/// A transparent background and a clamp that only the scene asks for are for path tracing alone.
void resolve_film(const RenderChoices& choices, const Scene& scene, ResolvedOptions& resolved) {
    RenderOptions& options = resolved.options;
    options.ids = choices.ids;
    if (choices.light_groups) options.light_groups = light_groups(scene);
    if (options.light_groups.size() == 1)
        resolved.notes.push_back(fmt::format(
            "no light of the scene has a group: all its light is in the group {}", OTHER_LIGHT));
    const RenderSettings& own = scene.settings;
    if (choices.clamp || options.integrator == IntegratorKind::path)
        options.clamp = choices.clamp.value_or(own.clamp.value_or(0.0f));
    if (options.clamp > 0) options.aovs |= 1u << AOV_CLAMPED;
    options.background = choices.background.value_or(own.background.value_or(options.background));
    if (options.background != Background::transparent) return;
    if (!choices.background && options.integrator != IntegratorKind::path) {
        options.background = Background::environment;
        resolved.notes.push_back(
            fmt::format("the background is not transparent, as --integrator {} knows no alpha",
                        word_of(options.integrator)));
        return;
    }
    options.aovs |= 1u << AOV_ALPHA;
}

/// Waves are rounded up to whole chunks.
void resolve_settings(const RenderChoices& choices, gpu::DeviceSettings& settings) {
    settings.width = choices.lanes.value_or(settings.width);
    settings.launch = choices.launch.value_or(settings.launch);
    if (choices.interleave) settings.interleave_above = *choices.interleave ? 0 : UINT64_MAX;
    settings.chunk = choices.chunk.value_or(std::max(settings.chunk, settings.width));
    settings.wave_size = choices.wave_size.value_or(settings.wave_size);
    if (settings.chunk == 0) return;
    const uint64_t chunks = (uint64_t(settings.wave_size) + settings.chunk - 1) / settings.chunk;
    settings.wave_size = uint32_t(std::min<uint64_t>(chunks * settings.chunk, UINT32_MAX));
}

uint32_t resolve_samples(const RenderChoices& choices, const RenderSettings& own,
                         const RenderOptions& options) {
    if (choices.samples) return *choices.samples;
    if (options.noise > 0) return MOST_FOR_NOISE;
    return choices.seconds ? ENDLESS : own.samples.value_or(options.samples);
}

/// What only the scene asks for gives way to an integrator that can't, and to parts of pictures.
void resolve_noise(const RenderChoices& choices, const RenderSettings& own,
                   ResolvedOptions& resolved) {
    RenderOptions& options = resolved.options;
    const bool can = options.integrator == IntegratorKind::path && !choices.sample_range;
    options.noise = choices.noise.value_or(can ? own.noise.value_or(0.0f) : 0.0f);
    if (!can && !choices.noise && own.noise.value_or(0.0f) > 0)
        resolved.notes.push_back(fmt::format(
            "the scene's noise is left out, as {} can't have one",
            choices.sample_range ? "--samples"
                                 : fmt::format("--integrator {}", word_of(options.integrator))));
    if (options.noise == 0) return;
    options.noise_exposure = choices.exposure.value_or(own.exposure.value_or(0.0f));
    options.aovs |= 1u << AOV_HALVES;
}

/// Only whole blocks of samples add up to the picture that has them all.
void resolve_range(const RenderChoices& choices, RenderOptions& options) {
    options.rectangle = choices.rectangle;
    const bool is_endless = choices.seconds && !choices.samples;
    options.picture_samples = is_endless ? 0 : options.samples;
    if (!choices.sample_range) return;
    if (options.noise > 0)
        throw InputError("--noise decides from all samples of a picture which ones follow; leave "
                         "out --samples");
    const auto [first, end] = *choices.sample_range;
    if (first >= end || end > options.samples)
        throw InputError("--samples {}:{}: the picture has {} samples, 0 to {}; give the first and "
                         "the one behind the last, and how many there are by --spp",
                         first, end, options.samples, options.samples - 1);
    for (const uint32_t border : {first, end})
        if (border % FILM_BLOCK != 0 && border != options.samples)
            throw InputError("--samples {}:{}: {} is not a multiple of {}, so that the parts would "
                             "not add up to the picture; use {} or {}",
                             first, end, border, FILM_BLOCK, border / FILM_BLOCK * FILM_BLOCK,
                             (border / FILM_BLOCK + 1) * FILM_BLOCK);
    options.first_sample = first;
    options.samples = end;
}

} // namespace

ResolvedOptions resolve_options(const RenderChoices& choices, const Scene& scene,
                                const gpu::DeviceFacts& facts) {
    const RenderSettings& own = scene.settings;
    ResolvedOptions resolved;
    RenderOptions& options = resolved.options;
    options.width = choices.width.value_or(own.width.value_or(options.width));
    options.height = choices.height.value_or(own.height.value_or(options.height));
    options.seconds = choices.seconds.value_or(0);
    options.integrator = choices.integrator.value_or(own.integrator.value_or(options.integrator));
    options.aovs = choices.aovs;
    resolve_noise(choices, own, resolved);
    options.samples = resolve_samples(choices, own, options);
    options.seed = choices.seed.value_or(own.seed.value_or(options.seed));
    options.filter = choices.filter.value_or(own.filter.value_or(options.filter));
    resolve_range(choices, options);
    options.camera = find_camera(choices.camera, scene);
    if (!scene.cameras.empty()) check_view(scene.cameras[options.camera], options);
    resolve_depth(choices, own, resolved);
    resolve_film(choices, scene, resolved);
    options.engine = choices.engine.value_or(options.engine);
    options.settings = gpu::default_settings(facts);
    resolve_settings(choices, options.settings);
    check_options(options);
    return resolved;
}

void check_light_groups(const Scene& scene, const RenderOptions& options) {
    if (!options.light_groups.empty() && options.light_groups != light_groups(scene))
        throw InputError("the film has the light of other groups than the scene has; ask for those "
                         "of the scene");
}

Display display_of(const RenderSettings& scene, IntegratorKind integrator) {
    const bool is_light = integrator == IntegratorKind::path || integrator == IntegratorKind::light;
    return {.exposure = scene.exposure.value_or(0.0f),
            .tone_map = scene.tone_map.value_or(is_light ? ToneMap::neutral : ToneMap::none)};
}

} // namespace onde
