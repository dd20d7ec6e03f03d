#include "app/motion_request.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace onde::app {
namespace {

constexpr double FRAMES_A_SECOND = 24;

bool has_motion(const std::vector<std::string>& aovs) {
    return std::ranges::any_of(aovs, [](const std::string& aov) {
        const FilmChannel* channel = find_channel(aov);
        return channel && channel->sums == AOV_MOTION;
    });
}

[[noreturn]] void throw_idle_rate() {
    throw InputError("--fps is of --frames, of --shutter, and of --aov motion of one picture --at "
                     "a moment; give "
                     "one of them, or leave --fps away");
}

/// Whether anything of a scene that has a next frame is elsewhere in it.
bool moves(const Scene& scene) {
    const auto view = &Camera::camera_to_world;
    return !scene.next->steps.empty() ||
           !std::ranges::equal(scene.cameras, scene.next->cameras, {}, view, view) ||
           !std::ranges::equal(scene.instances, scene.next->instances, {},
                               &Instance::object_to_world, &NextInstance::object_to_world);
}

} // namespace

double frames_a_second(const RenderRequest& request) {
    return request.frames_a_second.value_or(FRAMES_A_SECOND);
}

void check_frames_a_second(const RenderRequest& r) {
    if (!r.frames_a_second) return;
    if (!(*r.frames_a_second > 0 && std::isfinite(*r.frames_a_second)))
        throw InputError("--fps {} is not a positive number of frames a second",
                         *r.frames_a_second);
    const bool may_move =
        r.load.options.at && !r.turntable && (r.aovs.empty() || has_motion(r.aovs));
    if (r.frames.empty() && !may_move && !r.shutter) throw_idle_rate();
}

static void add_shutter(Scene& scene, const RenderRequest& r, const LoadOptions& options) {
    const double seconds =
        r.shutter ? *r.shutter / frames_a_second(r) : double(scene.settings.shutter.value_or(0.0f));
    if (!(seconds > 0)) return;
    const char* why =
        !scene.moment ? "no time passes without --at or --frames" : "--turntable moves the camera";
    if (!scene.moment || r.turntable) {
        if (r.shutter) scene.notes.push_back(fmt::format("Nothing is blurred: {}.", why));
        return;
    }
    load_shutter(scene, r.scene, options, seconds);
    if (r.shutter && !scene.shutter)
        scene.notes.push_back("Nothing is blurred: nothing moves while the shutter is open.");
}

static void add_next_frame(Scene& scene, const RenderRequest& request, const LoadOptions& options) {
    if (!has_motion(requested_aovs(request, scene))) {
        if (request.frames_a_second && request.frames.empty() && !request.shutter)
            throw_idle_rate();
        return;
    }
    if (request.turntable) return; // what moves is its camera
    if (!options.at) {
        scene.notes.push_back("The channel motion is 0: no time passes without --at or --frames.");
        return;
    }
    const double rate = frames_a_second(request);
    load_next_frame(scene, request.scene, options, *options.at + 1 / rate);
    if (request.frames.empty())
        scene.notes.push_back(
            fmt::format("The channel motion {} the next frame, 1/{:g} s later (--fps).",
                        moves(scene) ? "leads to" : "is 0: nothing moves until", rate));
}

void add_motion(Scene& scene, const RenderRequest& request, const LoadOptions& options) {
    add_next_frame(scene, request, options);
    add_shutter(scene, request, options);
}

} // namespace onde::app
