#include "session/session.h"

#include "core/error.h"
#include "core/timer.h"
#include "image/tone.h"
#include "render/frame.h"
#include "scene/check.h"
#include "scene/light_groups.h"
#include "scene/load.h"
#include "scene/mapping.h"
#include "session/choices.h"
#include "session/findings.h"
#include "session/integrators.h"
#include "upload/layout_choice.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>
#include <utility>

namespace onde {

Session::Session(gpu::Programs& programs, Scene scene, SessionOptions options)
    : programs_(programs), scene_(std::move(scene)), options_(std::move(options)) {
    check_options(options_.render);
    check_light_groups(scene_, options_.render);
    check_view(camera(), options_.render);
    for (const std::string& sentence : scene_.notes) note(sentence);
    note_mapping();
    complete_next_frame();
    denoiser_ = make_denoiser();
    fit_waves(PackedScene{}); // what does not fit at all is found before the scene is packed
    if (options_.choose_layout)
        options_.bvh.layout =
            suitable_layout(programs_, [&](std::string sentence) { note(std::move(sentence)); });
    const Timer timer;
    PackedScene packed = pack_scene(scene_, options_.bvh, options_.lights,
                                    {.largest_buffer = device().facts().max_allocation});
    pack_seconds_ = timer.seconds();
    packed.features = features_of(packed);
    fit_waves(packed);
    placed_ = std::make_unique<DeviceScene>(device(), std::move(packed));
}

Session::~Session() = default;

void Session::note(std::string sentence) {
    if (options_.on_note) options_.on_note(sentence);
    notes_.push_back(std::move(sentence));
}

void Session::complete_next_frame() {
    if ((options_.render.aovs >> AOV_MOTION & 1) && !scene_.next) {
        scene_.next = standing_still(scene_);
        change_ = placed_ ? SceneChange::transforms : SceneChange::none;
    }
}

std::unique_ptr<PictureDenoiser> Session::make_denoiser() {
    if (options_.denoiser.denoiser == Denoiser::off) return nullptr;
    check_denoisable(options_.render.integrator);
    return std::make_unique<PictureDenoiser>(
        programs_, options_.denoiser, options_.render.width,
        [&](std::string sentence) { note(std::move(sentence)); });
}

void Session::note_mapping() {
    for (std::string& sentence : mapping_notes(scene_, options_.render.integrator))
        note(std::move(sentence));
}

SceneFeatures Session::features_of(const PackedScene& packed) const {
    SceneFeatures features = options_.features.value_or(packed.features);
    features.layout = packed.features.layout;
    features.light_tree = packed.features.light_tree;
    features.motion = packed.features.motion;
    features.split_texels = packed.features.split_texels;
    features.mip_textures = packed.features.mip_textures;
    features.shutter = scene_.shutter && knows_time(options_.render.integrator);
    features.projections |= packed.features.projections;
    return options_.further_features ? joined(features, *options_.further_features) : features;
}

bool Session::halve_waves() {
    gpu::DeviceSettings& settings = options_.render.settings;
    const uint32_t half = settings.wave_size / 2 / settings.chunk * settings.chunk;
    if (half == 0) return false;
    settings.wave_size = half;
    return true;
}

void Session::fit_waves(const PackedScene& scene) {
    const uint32_t asked = options_.render.settings.wave_size;
    const auto plan = [&] {
        MemoryPlan all = plan_memory(scene_, options_.render, device().facts(), scene.features);
        all.add_scene(scene.device_buffers());
        return all;
    };
    MemoryPlan fitted = plan();
    while (!fits(fitted, device().facts()) && !fitted.paths.empty() && halve_waves())
        fitted = plan();
    check_memory(fitted, device().facts());
    note_waves(asked);
}

void Session::note_waves(uint32_t asked) {
    const uint32_t taken = options_.render.settings.wave_size;
    if (taken != asked)
        note(fmt::format("waves of {} paths do not fit the memory of {}; they have {} paths now",
                         asked, device().facts().name, taken));
}

const PackedScene& Session::packed() {
    update();
    return placed_->packed();
}

MemoryPlan Session::memory_plan() {
    MemoryPlan plan = plan_memory(scene_, options_.render, device().facts(), packed().features);
    plan.add_scene(packed().device_buffers());
    return plan;
}

void Session::update() {
    if (change_ == SceneChange::none) return;
    const Timer timer;
    placed_->update(device(), scene_, change_, options_.bvh, options_.lights);
    placed_->set_features(features_of(placed_->packed()));
    pack_seconds_ = timer.seconds();
    change_ = SceneChange::none;
}

IntegratorContext Session::context() {
    update();
    return {programs_, &scene_,         *placed_,
            camera(),  options_.render, options_.timed ? &profiler_ : nullptr};
}

const gpu::BuildReport& Session::prepare() {
    const uint32_t asked = options_.render.settings.wave_size;
    while (!integrator_) try {
            integrator_ = make_integrator(context());
        } catch (const gpu::OutOfMemory&) { // the device refused what its facts allow
            if (!halve_waves()) throw;
        }
    note_waves(asked);
    return integrator_->build_report();
}

RenderOutcome Session::render(const std::function<bool(const Progress&)>& keep_going) {
    prepare();
    std::atomic<bool> stop{false};
    return onde::render(*integrator_, options_.render, stop, [&](const Progress& progress) {
        if (keep_going && !keep_going(progress)) stop = true;
    });
}

Film& Session::film() {
    prepare();
    return integrator_->film();
}

/// Before a transparent background, with the film's alpha as the fourth channel.
Image Session::before_background(const Image& radiance) {
    if (options_.render.background != Background::transparent) return radiance;
    return with_alpha(radiance, film().develop(*find_channel("alpha")));
}

Image Session::picture() {
    return before_background(film().develop());
}

std::vector<Image> Session::light_groups() {
    std::vector<FilmChannel> channels;
    for (const std::string& group : options_.render.light_groups)
        channels.push_back(group_channel(group, channels.size()));
    return film().develop(channels);
}

DenoisedImage Session::denoised() {
    if (!denoiser_)
        throw InputError("the picture can't be denoised: the options ask for no denoiser");
    const Timer timer;
    DenoisedPicture denoised = denoiser_->denoise(film());
    return {before_background(denoised.radiance), std::move(denoised.parts), denoiser_->name(),
            timer.seconds()};
}

void Session::clear() {
    prepare();
    integrator_->clear();
}

KeptFilm Session::keep_film() {
    const RenderOptions& o = options_.render;
    const Rectangle all{0, 0, o.width, o.height};
    return {film_header(), o.rectangle.value_or(all), film().contents()};
}

FilmHeader Session::film_header() const {
    const RenderOptions& o = options_.render;
    const uint32_t samples = o.picture_samples > 0 ? o.picture_samples : o.samples;
    return {film_identity(scene_, o, options_.bvh, options_.lights.sampler),
            {ONDE_VERSION, programs_.sources().hash(), device_class(device().facts())},
            device().facts().name,
            samples,
            display_of(scene_.settings, o.integrator),
            o.ids ? id_names(scene_) : IdNames{}};
}

void Session::restore_film(const KeptFilm& kept) {
    check_same(kept.header, film_header());
    const Rectangle all{0, 0, options_.render.width, options_.render.height};
    const Rectangle window = options_.render.rectangle.value_or(all);
    if (kept.window != window)
        throw InputError("the film has {}x{} pixels from {},{}; go on with just these by "
                         "--rectangle {},{},{},{}",
                         kept.window.width, kept.window.height, kept.window.x, kept.window.y,
                         kept.window.x, kept.window.y, kept.window.width, kept.window.height);
    clear();
    integrator_->film().restore(kept.contents);
}

RayCounts Session::ray_counts() {
    prepare();
    return integrator_->ray_counts();
}

double Session::clamped_share() {
    if (options_.render.clamp <= 0) return 0;
    const auto light_of = [](const Image& image) {
        return std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0);
    };
    const double lost = light_of(film().develop(*find_channel("clamped")));
    return lost > 0 ? lost / (lost + light_of(film().develop())) : 0.0;
}

std::optional<NoiseReport> Session::noise() {
    if (options_.render.noise <= 0) return std::nullopt;
    return noise_report(film(), options_.render);
}

std::vector<std::string> Session::findings() {
    prepare();
    std::vector<std::string> all = integrator_->findings();
    if (options_.render.clamp > 0)
        all.push_back(clamp_sentence(options_.render.clamp, clamped_share()));
    if (const auto report = noise()) all.push_back(noise_sentence(*report, options_.render.noise));
    return all;
}

SampleReport Session::inspect(const PixelSample& at) {
    switch (options_.render.integrator) {
    case IntegratorKind::path:
        return inspect_path(context(), at);
    case IntegratorKind::whitted:
        return inspect_whitted(context(), at);
    default:
        throw InputError("a sample can be followed by --integrator path or whitted only, not by {}",
                         word_of(options_.render.integrator));
    }
}

TraversalCost Session::traversal_cost() {
    return measure_traversal_cost(context());
}

} // namespace onde
