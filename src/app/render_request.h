// What the user asked of `onde render`, as the command line gives it: every option optional.
#pragma once

#include "core/command_line.h"

#include "accel/bvh.h"
#include "app/load_request.h"
#include "image/image_io.h"
#include "scene/load.h"
#include "session/choices.h"
#include "session/machine.h"
#include "session/session.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace onde::app {

/// How the channels of an .exr are called.
enum class ExrNames { plain, blender };

constexpr auto enum_words(ExrNames) {
    return std::array{EnumWord{ExrNames::plain, "plain"}, EnumWord{ExrNames::blender, "blender"}};
}

/// Where and from what the kernels are built.
struct MachineRequest {
    std::string device;
    std::filesystem::path kernels; ///< empty: the ones inside the program
    bool no_cache = false;
};

/// Open devices, at least one.
using Machines = std::vector<std::unique_ptr<Machine>>;

struct RenderRequest {
    std::filesystem::path scene;
    LoadRequest load;
    std::vector<std::filesystem::path> outputs;
    std::vector<std::string> aovs; ///< of aov_words()
    std::string size;              ///< WIDTHxHEIGHT, or empty
    RenderChoices choices;
    BvhOptions bvh;
    std::optional<LightSampler> light_sampler;
    std::optional<BvhLayout> layout;
    std::string environment;
    MachineRequest machine;
    bool mixed_devices = false;
    bool mpi = false;            ///< this is a rank of an MPI job
    std::filesystem::path parts; ///< folder of such a job, or empty
    float environment_rotation = 0.0f;
    std::optional<float> exposure;
    std::optional<ToneMap> tone_map;
    Studio studio = Studio::automatic;
    GroundPlane ground = GroundPlane::automatic;
    std::optional<Denoiser> denoise; ///< or as the scene says
    DenoiserOptions denoiser;        ///< but for which
    ExrNames exr_names = ExrNames::plain;
    bool full_float = false;
    std::filesystem::path json;
    std::optional<uint32_t> turntable;   ///< pictures of a turn, from 1 on
    std::filesystem::path film, resume;  ///< film files: to write, to go on from; or empty
    std::optional<double> checkpoint;    ///< seconds between two writes of the film
    std::string sample_range, rectangle; ///< FIRST:END and X,Y,WIDTH,HEIGHT, or empty
    std::string frames;                  ///< of an animation, FIRST:LAST, or empty
    std::optional<double> frames_a_second;
    std::optional<double> shutter;        ///< frames for which it is open, or as the scene says
    std::optional<Projection> projection; ///< of its cameras, or as the scene says
    bool stats = false, quiet = false;
};

void declare_machine(Command& command, MachineRequest& request);

/// The options of what lights the scene, and of the ground that takes its shadow.
void declare_light(Command& command, RenderRequest& request);

/// The options of how light is shown in a picture.
void declare_display(Command& command, RenderRequest& request);

/// The options of what takes the noise from a picture.
void declare_denoiser(Command& command, RenderRequest& request);

/// Declares every option of `onde render` on its subcommand.
void declare_options(Command& command, RenderRequest& request);

/// The options of ranks of an MPI job.
void declare_mpi(Command& command, RenderRequest& request);

/// Those of them that decide what a sample is, for commands that replay one.
void declare_replay_options(Command& command, RenderRequest& request);

/// How the scene is to be loaded, with the environment that is asked for. Throws InputError.
LoadOptions requested_load(const RenderRequest& request);

/// The scene of the request. Throws InputError.
Scene load_requested_scene(const RenderRequest& request);

/// Throws InputError for values that are wrong whatever the scene is.
void check_request(const RenderRequest& request);

/// Opens the device with the kernels that are asked for. Throws InputError where several are named.
Machine open_machine(const MachineRequest& request, gpu::Profiling profiling = gpu::Profiling::off);

/// Opens the devices that the request names. Throws InputError for several whose samples have other
/// bits, unless that is asked for, and for what several devices can't do.
Machines open_machines(const RenderRequest& request, gpu::Profiling profiling);

/// Logs it.
void tell_note(const std::string& note);

/// Of a session among others.
struct SessionExtras {
    std::optional<SceneFeatures> features{}; ///< that kernels are compiled for too
    std::function<void(const std::string&)> on_note = tell_note;
};

/// A scene in a session of its own, as the request says. Throws InputError and DeviceError.
Session open_session(Machine& machine, Scene scene, const RenderRequest& request,
                     const SessionExtras& extras = {});

/// What --aov can add: the traversal cost, light by groups, and the channels of the film but the
/// picture itself.
inline constexpr const char* TRAVERSAL_COST = "traversal-cost";
inline constexpr const char* LIGHT_GROUPS = "light-groups";
std::vector<std::string> aov_words();

/// Those that are asked for, by the request or else by the scene. Throws InputError for words of
/// the scene that are none, or are there twice; those that its integrator does not have are left
/// out.
std::vector<std::string> requested_aovs(const RenderRequest& request, const Scene& scene);

/// Where a picture's companion of that name goes: out.png's "a" to out.a.png.
std::filesystem::path aov_path(const std::filesystem::path& output, const std::string& name);

/// Whether a picture of that name is OpenEXR; else it is PNG.
bool is_exr(const std::filesystem::path& output);

/// The outputs that are asked for, or SCENE's name with .png in the current folder. Throws
/// InputError unless each is .png, .exr or standard output.
std::vector<std::filesystem::path> named_outputs(const RenderRequest& request);

/// Throws InputError unless these, what is written beside them, and the report can be written, each
/// to a place of its own.
void check_outputs(const std::vector<std::filesystem::path>& outputs, const RenderRequest& request);

/// Throws InputError where one of them is a file that the render reads.
void check_outputs_not_read(const std::vector<std::filesystem::path>& outputs,
                            const RenderRequest& request, const Scene& scene);

} // namespace onde::app
