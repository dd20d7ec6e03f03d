#include "app/render_request.h"

#include "app/film_request.h"
#include "app/id_channels.h"
#include "app/motion_request.h"

#include "core/error.h"
#include "core/log.h"
#include "gpu/device_list.h"
#include "scene/light_groups.h"
#include "scene/load.h"
#include "scene/load_context.h"
#include "upload/layout_choice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// As in scene files.
constexpr float MOST_STOPS = 64.0f;

std::pair<uint32_t, uint32_t> parse_size(const std::string& text) {
    if (const auto size = parse_pair(text, 'x', "--size")) {
        const auto check = [&](const char* side, uint32_t pixels) {
            if (pixels < FILM_SIZE.low || pixels > FILM_SIZE.high)
                throw InputError("--size {}: {} {} is out of range; use {} to {}", text, side,
                                 pixels, FILM_SIZE.low, FILM_SIZE.high);
        };
        check("width", size->first);
        check("height", size->second);
        return *size;
    }
    throw InputError("--size {} is not of the form WIDTHxHEIGHT, for example 640x480", text);
}

void check_named_once(const std::vector<std::string>& aovs, const char* by) {
    for (auto aov = aovs.begin(); aov != aovs.end(); ++aov)
        if (std::find(aovs.begin(), aov, *aov) != aov)
            throw InputError("{} names {} twice; name it once", by, *aov);
}

IntegratorKind integrator_of(const RenderRequest& request, const RenderSettings& scene) {
    return request.choices.integrator.value_or(scene.integrator.value_or(IntegratorKind::path));
}

/// Whether only path tracing has it.
bool is_of_paths(const std::string& aov) {
    const FilmChannel* channel = find_channel(aov);
    return aov == LIGHT_GROUPS || value_of<IdChannel>(aov) ||
           (channel && channel->sums < AOV_COUNT);
}

/// Says of options for .exr pictures that there is none.
void tell_idle_names(const RenderRequest& request) {
    if (request.exr_names == ExrNames::plain && !request.full_float) return;
    if (std::ranges::none_of(request.outputs, is_exr))
        spdlog::warn("{} does nothing, as it is of .exr pictures and none is written",
                     request.full_float ? "--float" : "--exr-names");
}

/// Whether something is asked of a denoiser beside that there is one.
bool describes_denoiser(const RenderRequest& request) {
    return !request.denoiser.oidn.empty() || request.denoiser.quality != DenoiserOptions().quality;
}

/// What the denoiser is to be, if there is one. One that only the scene asks for is for path
/// tracing alone.
DenoiserOptions requested_denoiser(const RenderRequest& request, const RenderSettings& scene) {
    const IntegratorKind integrator = integrator_of(request, scene);
    DenoiserOptions options = request.denoiser;
    const Denoiser own = scene.denoise.value_or(Denoiser::off);
    const bool is_path = integrator == IntegratorKind::path;
    options.denoiser = request.denoise.value_or(is_path ? own : Denoiser::off);
    if (options.denoiser != Denoiser::off) check_denoisable(integrator);
    return options;
}

} // namespace

/// A view of another projection; what that has no use for goes.
static void set_projection(Camera& camera, Projection projection) {
    camera.projection = projection;
    if (!is_wide(camera)) return;
    camera.orthographic_height.reset();
    camera.screen.reset();
}

LoadOptions requested_load(const RenderRequest& request) {
    LoadOptions options = load_options(request.load);
    options.studio = request.studio;
    options.ground = request.ground;
    if (!request.size.empty()) {
        const auto [width, height] = parse_size(request.size);
        options.size = glm::uvec2(width, height);
    }
    if (!request.environment.empty()) {
        LoadContext context(options);
        options.environment =
            load_environment_within(context, request.environment, request.environment_rotation);
    }
    return options;
}

Scene load_requested_scene(const RenderRequest& request) {
    const LoadOptions options = requested_load(request);
    Scene scene = load_scene(request.scene, options);
    add_motion(scene, request, options);
    return scene;
}

void check_request(const RenderRequest& r) {
    if (!r.size.empty()) parse_size(r.size);
    load_options(r.load);
    check_film_request(r);
    // "nan" and "inf" are read as numbers.
    if (r.choices.clamp && !(*r.choices.clamp > 0 && std::isfinite(*r.choices.clamp)))
        throw InputError("--clamp {} is not a positive radiance", *r.choices.clamp);
    if (r.choices.noise && !(*r.choices.noise >= 0 && std::isfinite(*r.choices.noise)))
        throw InputError("--noise {} is no share of white, such as 0.02; 0 is none",
                         *r.choices.noise);
    if (r.choices.seconds && !(*r.choices.seconds > 0 && std::isfinite(*r.choices.seconds)))
        throw InputError("--time {} is not a positive number of seconds", *r.choices.seconds);
    check_named_once(r.aovs, "--aov");
    tell_idle_names(r);
    if (r.shutter && !(*r.shutter >= 0 && std::isfinite(*r.shutter)))
        throw InputError("--shutter {} is no part of a frame, such as 0.5; 0 is none", *r.shutter);
    if (r.exposure && !(std::abs(*r.exposure) <= MOST_STOPS))
        throw InputError("--exposure {} is out of range; use {} to {} stops", *r.exposure,
                         -MOST_STOPS, MOST_STOPS);
    if (!std::isfinite(r.environment_rotation))
        throw InputError("--environment-rotation {} is not a number of degrees",
                         r.environment_rotation);
}

static std::optional<gpu::ProgramCache> requested_cache(const MachineRequest& request) {
    return request.no_cache ? std::nullopt : std::optional(gpu::ProgramCache());
}

Machine open_machine(const MachineRequest& request, gpu::Profiling profiling) {
    if (gpu::names_several(request.device))
        throw InputError("{} names several devices, by which only onde render makes a picture; "
                         "name one with --device",
                         request.device.empty() ? "ONDE_DEVICE" : "--device " + request.device);
    return Machine(request.device, gpu::KernelSources::from(request.kernels),
                   requested_cache(request), profiling);
}

/// Devices of one class make the same bits.
static void check_one_class(const Machines& machines) {
    const std::string first = device_class(machines.front()->device.facts());
    for (const auto& machine : machines)
        if (const std::string other = device_class(machine->device.facts()); other != first)
            throw InputError("--device names devices of several classes ({}; {}), whose samples "
                             "have other bits, so that the picture's would depend on which of them "
                             "took what; name devices of one class, or add --mixed-devices",
                             first, other);
}

Machines open_machines(const RenderRequest& request, gpu::Profiling profiling) {
    const auto sources = gpu::KernelSources::from(request.machine.kernels);
    Machines machines;
    for (gpu::Device& device : gpu::open_devices(request.machine.device, profiling))
        machines.push_back(std::make_unique<Machine>(std::move(device), sources,
                                                     requested_cache(request.machine)));
    if (!request.mixed_devices) check_one_class(machines);
    if (request.mixed_devices && machines.size() == 1)
        spdlog::warn("--mixed-devices does nothing, as there is one device");
    if (machines.size() > 1 && request.choices.seconds)
        throw InputError("--time is for one device; name one, or say how many samples by --spp");
    return machines;
}

void tell_note(const std::string& note) {
    spdlog::info("{}", note);
}

Session open_session(Machine& machine, Scene scene, const RenderRequest& request,
                     const SessionExtras& extras) {
    RenderChoices choices = request.choices;
    choices.sample_range = requested_samples(request);
    choices.rectangle = requested_rectangle(request);
    choices.exposure = request.exposure;
    if (!request.size.empty()) std::tie(choices.width, choices.height) = parse_size(request.size);
    for (const std::string& aov : requested_aovs(request, scene)) {
        if (const FilmChannel* channel = find_channel(aov); channel && channel->sums < AOV_COUNT)
            choices.aovs |= 1u << channel->sums;
        if (aov == LIGHT_GROUPS) choices.light_groups = true;
        if (value_of<IdChannel>(aov)) choices.ids = true;
    }
    const DenoiserOptions denoiser = requested_denoiser(request, scene.settings);
    if (denoiser.denoiser != Denoiser::off) choices.aovs |= denoiser_aovs();
    if (denoiser.denoiser == Denoiser::off && describes_denoiser(request))
        scene.notes.push_back("--denoiser-library and --denoise-quality do nothing without "
                              "--denoise.");
    if (request.projection)
        for (Camera& camera : scene.cameras) set_projection(camera, *request.projection);
    const ResolvedOptions resolved = resolve_options(choices, scene, machine.device.facts());
    scene.notes.insert(scene.notes.end(), resolved.notes.begin(), resolved.notes.end());
    SessionOptions options{.render = resolved.options, .bvh = request.bvh};
    options.lights.sampler = request.light_sampler.value_or(
        scene.settings.light_sampler.value_or(LightSampler::automatic));
    options.bvh.layout = request.layout.value_or(BvhLayout::wide);
    options.choose_layout = !request.layout;
    options.denoiser = denoiser;
    options.timed = request.stats || !request.json.empty();
    options.on_note = extras.on_note;
    options.further_features = extras.features;
    return Session(machine.programs, std::move(scene), std::move(options));
}

std::vector<std::string> aov_words() {
    std::vector<std::string> words{TRAVERSAL_COST, LIGHT_GROUPS};
    for (const FilmChannel& channel : FILM_CHANNELS)
        if (channel.name != RADIANCE.name) words.emplace_back(channel.name);
    for (const std::string_view word : all_words<IdChannel>()) words.emplace_back(word);
    return words;
}

std::vector<std::string> requested_aovs(const RenderRequest& request, const Scene& scene) {
    if (!request.aovs.empty() || !scene.settings.aov) return request.aovs;
    const std::vector<std::string> words = aov_words();
    for (const std::string& aov : *scene.settings.aov)
        if (std::ranges::find(words, aov) == words.end())
            throw InputError("{}: [render]: aov names {}, which is none; there are {}",
                             request.scene.string(), aov, fmt::join(words, ", "));
    check_named_once(*scene.settings.aov, "aov of [render]");
    std::vector<std::string> aovs = *scene.settings.aov;
    if (integrator_of(request, scene.settings) != IntegratorKind::path)
        std::erase_if(aovs, is_of_paths);
    return aovs;
}

} // namespace onde::app
