#include "app/sequence.h"

#include "app/film_request.h"
#include "app/motion_request.h"

#include "core/error.h"
#include "core/log.h"
#include "core/output.h"
#include "core/timer.h"
#include "scene/stage.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// The most moments of an animation that its camera is fitted to.
constexpr size_t MOST_FITTED = 16;

/// The camera turned about the vertical axis through the middle of the scene, counter-clockwise
/// seen from above.
Camera turned_camera(const Camera& camera, const SceneBounds& bounds, double radians) {
    const glm::dvec3 middle = 0.5 * (glm::dvec3(bounds.low) + glm::dvec3(bounds.high));
    const glm::dmat4 there = glm::translate(glm::dmat4(1.0), middle);
    const glm::dmat4 turn = glm::rotate(there, radians, glm::dvec3(0, 1, 0));
    Camera turned = camera;
    turned.camera_to_world =
        glm::mat4(glm::translate(turn, -middle) * glm::dmat4(camera.camera_to_world));
    return turned;
}

void check_sequence(const RenderRequest& r) {
    check_frames_a_second(r);
    if (r.frames.empty()) return;
    if (r.turntable)
        throw InputError("--frames and --turntable can't be had at once; give one of them");
    if (r.load.options.at)
        throw InputError("--at is one moment and --frames are many; give one of them");
}

std::vector<Shot> frame_shots(const RenderRequest& request) {
    const auto range = parse_pair(request.frames, ':', "--frames");
    if (!range)
        throw InputError("--frames {} is not of the form FIRST:LAST, for example 0:47",
                         request.frames);
    const auto [first, last] = *range;
    if (last < first)
        throw InputError("--frames {} ends before it begins; give the smaller number first",
                         request.frames);
    if (last - first >= MOST_PICTURES)
        throw InputError("--frames {} has more than {} frames; render them in parts",
                         request.frames, MOST_PICTURES);
    std::vector<Shot> shots;
    for (uint32_t i = 0; i <= last - first; ++i)
        shots.push_back({.name = fmt::format("frame {} ({} of {})", first + i, i + 1,
                                             uint64_t(last - first) + 1),
                         .number = first + i,
                         .at = (first + i) / frames_a_second(request)});
    return shots;
}

std::vector<Shot> turntable_shots(uint32_t count) {
    std::vector<Shot> shots;
    const auto turn_of = [&](uint32_t picture) { return 2 * std::numbers::pi * picture / count; };
    for (uint32_t i = 0; i < count; ++i)
        shots.push_back({.name = fmt::format("picture {} of {}", i + 1, count),
                         .number = i + 1,
                         .turn = turn_of(i),
                         .next_turn = turn_of(i + 1)});
    return shots;
}

/// Some of the shots' moments, the first and the last among them.
std::vector<double> moments_to_fit(const std::vector<Shot>& shots) {
    const size_t count = std::min(shots.size(), MOST_FITTED);
    std::vector<double> moments;
    for (size_t i = 0; i < count; ++i)
        moments.push_back(*shots[count > 1 ? i * (shots.size() - 1) / (count - 1) : 0].at);
    return moments;
}

} // namespace

fs::path numbered_path(const fs::path& output, uint32_t number) {
    const std::string name = output.filename().string();
    const size_t last = name.find_last_of('#');
    if (last == std::string::npos) {
        fs::path path = output;
        return path.replace_extension(fmt::format("{:04}{}", number, output.extension().string()));
    }
    const size_t before = name.find_last_not_of('#', last);
    const size_t first = before == std::string::npos ? 0 : before + 1;
    return output.parent_path() / fmt::format("{}{:0{}}{}", name.substr(0, first), number,
                                              last + 1 - first, name.substr(last + 1));
}

bool is_sequence(const RenderRequest& request) {
    return request.turntable || !request.frames.empty();
}

std::vector<Shot> resolve_shots(const RenderRequest& request) {
    check_sequence(request);
    std::vector<Shot> shots{Shot{}};
    if (request.turntable) shots = turntable_shots(*request.turntable);
    if (!request.frames.empty()) shots = frame_shots(request);
    const std::vector<fs::path> outputs = named_outputs(request);
    if (is_sequence(request) && std::ranges::any_of(outputs, is_standard_output))
        throw InputError("numbered pictures can't go to standard output; name a file with -o");
    std::vector<fs::path> all;
    for (Shot& shot : shots)
        for (const fs::path& path : outputs) {
            shot.outputs.push_back(is_sequence(request) ? numbered_path(path, shot.number) : path);
            all.push_back(shot.outputs.back());
        }
    check_outputs(all, request);
    place_films(shots, request);
    return shots;
}

ShotSession::ShotSession(const Machines& machines, const RenderRequest& request,
                         const std::vector<Shot>& shots)
    : machines_(machines), request_(request), options_(requested_load(request)) {
    options_.all_round = request.turntable.has_value();
    if (shots.front().at && shots.size() > 1)
        options_.stage = fit_stage(request.scene, options_, moments_to_fit(shots));
    std::vector<fs::path> outputs;
    for (const Shot& shot : shots) std::ranges::copy(shot.outputs, std::back_inserter(outputs));
    load(shots.front(), outputs);
}

void ShotSession::load(const Shot& shot, const std::vector<fs::path>& outputs) {
    const Timer timer;
    group_.reset(); // its memory first
    if (shot.at) options_.at = shot.at;
    Scene scene = load_scene(request_.scene, options_);
    add_motion(scene, request_, options_);
    check_outputs_not_read(outputs, request_, scene);
    if (!shot.film.empty()) check_not_read(shot.film, scene.files);
    load_seconds_ += timer.seconds();
    const auto tell = [this](const std::string& note) {
        const std::lock_guard lock(telling_);
        if (told_.insert(note).second) spdlog::info("{}", note);
    };
    std::vector<std::unique_ptr<Session>> sessions;
    for (const auto& machine : machines_)
        sessions.emplace_back(
            new Session(open_session(*machine, scene, request_, {compiled_, tell})));
    group_ = std::make_unique<DeviceGroup>(std::move(sessions), [](const std::string& why) {
        spdlog::warn("{}; the other devices go on with its work", why);
    });
    Session& session = group_->session();
    compiled_ = session.packed().features;
    at_ = shot.at;
    camera_ = session.camera();
    bounds_ = scene_bounds(session.scene());
}

DeviceGroup& ShotSession::show(const Shot& shot) {
    if (at_ != shot.at) load(shot, shot.outputs);
    if (request_.turntable) turn(shot);
    return *group_;
}

void ShotSession::turn(const Shot& shot) {
    const Scene& scene = group_->session().scene();
    // The added studio stands about the camera, as about a turntable on which the model turns.
    if (shot.turn != 0) {
        group_->set_camera(turned_camera(camera_, bounds_, shot.turn));
        if (scene.has_studio) group_->set_environment_rotation(float(shot.turn));
    }
    group_->set_next_view(turned_camera(camera_, bounds_, shot.next_turn),
                          scene.has_studio ? float(shot.next_turn) : scene.environment.rotation);
}

} // namespace onde::app
