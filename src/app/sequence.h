// The pictures of one render: one, a turn around the scene, or the frames of an animation.
#pragma once

#include "app/render_request.h"
#include "session/device_group.h"

#include <memory>
#include <set>
#include <utility>

namespace onde::app {

/// The most pictures of one render.
inline constexpr uint32_t MOST_PICTURES = 100000;

/// One picture.
struct Shot {
    std::string name{};         ///< "frame 12 (3 of 24)"; empty where it is the only one
    uint32_t number = 0;        ///< of its files
    double turn = 0;            ///< of the camera about the scene, radians
    double next_turn = 0;       ///< of the next picture's
    std::optional<double> at{}; ///< seconds of the animation
    std::vector<std::filesystem::path> outputs{};
    std::filesystem::path film{}, resume{}; ///< film files, or empty
};

/// Whether the request is of numbered pictures.
bool is_sequence(const RenderRequest& request);

/// Every picture of the request, each with its outputs. Throws InputError where one of them can't
/// be written, and for options of sequences that are wrong or contradict each other.
std::vector<Shot> resolve_shots(const RenderRequest& request);

/// Where picture `number` goes: 7 of out.png to out.0007.png, of out-##.png to out-07.png.
std::filesystem::path numbered_path(const std::filesystem::path& output, uint32_t number);

/// The sessions that show the pictures of a request, one after the other.
class ShotSession {
  public:
    /// Loads what the first picture shows. The machines and the request outlive it.
    ShotSession(const Machines& machines, const RenderRequest& request,
                const std::vector<Shot>& shots);

    /// As it shows a picture of the request: what the picture before it did not show is loaded.
    /// Kernels are compiled for the first picture and, where a later one needs more, for that.
    DeviceGroup& show(const Shot& shot);

    /// Seconds of loading since it was asked last.
    double take_load_seconds() { return std::exchange(load_seconds_, 0); }

  private:
    /// Turns the camera as a picture of a turntable has it.
    void turn(const Shot& shot);
    void load(const Shot& shot, const std::vector<std::filesystem::path>& outputs);

    const Machines& machines_;
    const RenderRequest& request_;
    LoadOptions options_;
    std::unique_ptr<DeviceGroup> group_;
    std::optional<SceneFeatures> compiled_; ///< what the kernels so far can do
    std::mutex telling_;                    ///< sessions do on threads of their own
    std::set<std::string> told_;            ///< notes, each once
    std::optional<double> at_;              ///< what the session shows
    Camera camera_;                         ///< of what it shows, before it was turned
    SceneBounds bounds_;
    double load_seconds_ = 0;
};

} // namespace onde::app
