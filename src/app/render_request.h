// What the user asked of `onde render`, as the command line gives it: every option optional.
#pragma once

#include "core/command_line.h"

#include "accel/bvh.h"
#include "gpu/program.h"
#include "image/image_io.h"
#include "render/options.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace onde::app {

/// Where and from what the kernels are built.
struct MachineRequest {
    std::string device;
    std::filesystem::path kernels; ///< empty: the ones inside the program
    bool no_cache = false;

    gpu::KernelSources sources() const { return gpu::KernelSources::from(kernels); }
    std::optional<gpu::ProgramCache> cache() const {
        return no_cache ? std::nullopt : std::optional<gpu::ProgramCache>(std::in_place);
    }
};

struct RenderRequest {
    std::filesystem::path scene;
    std::vector<std::filesystem::path> outputs;
    bool cost_aov = false;
    std::string size;
    std::optional<uint32_t> samples, depth, seed, wave_size, chunk, width, tree_slots;
    std::optional<double> seconds;
    std::optional<IntegratorKind> integrator;
    std::optional<Engine> engine;
    std::optional<gpu::Launch> launch;
    std::optional<gpu::QueueKind> queue;
    std::optional<bool> packets, turns;
    std::optional<Filter> filter;
    BvhOptions bvh;
    std::optional<BvhLayout> layout;
    std::string camera, environment;
    MachineRequest machine;
    float environment_rotation = 0.0f;
    std::optional<float> exposure;
    ToneMap tone_map = ToneMap::none;
    bool full_float = false;
    std::filesystem::path json;
    bool stats = false, quiet = false;
};

void declare_machine(Command& command, MachineRequest& request);

/// Declares every option of `onde render` on its subcommand.
void declare_options(Command& command, RenderRequest& request);

/// Those of them that decide what a sample is, for commands that replay one.
void declare_replay_options(Command& command, RenderRequest& request);

/// The scene, under the request's environment. Throws InputError.
Scene load_requested_scene(const RenderRequest& request);

/// Throws InputError for values that are wrong whatever the scene is.
void check_request(const RenderRequest& request);

/// The request over the scene's own settings over the defaults. Throws InputError.
RenderOptions resolve_options(const RenderRequest& request, const Scene& scene,
                              const gpu::DeviceFacts& facts);

/// How the tree is built and laid out for the device, on which layouts may be measured first.
BvhOptions resolve_bvh(const RenderRequest& request, gpu::Programs& programs);

/// Where a picture's companion of that name goes: out.png's "tests" to out.tests.png.
std::filesystem::path aov_path(const std::filesystem::path& output, const std::string& name);

/// The outputs, or SCENE's name with .png in the current folder when none was given; each must be
/// .png or .exr and be writable. Throws InputError.
std::vector<std::filesystem::path> resolve_outputs(const RenderRequest& request);

} // namespace onde::app
