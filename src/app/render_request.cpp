#include "app/render_request.h"

#include "app/film_request.h"
#include "app/id_channels.h"
#include "app/sequence.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output.h"
#include "gpu/device_list.h"
#include "scene/light_groups.h"
#include "scene/load.h"
#include "scene/load_context.h"
#include "upload/layout_choice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// As in scene files.
constexpr float MOST_STOPS = 64.0f;

const std::map<std::string, bool> SWITCH{{"on", true}, {"off", false}};

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

void declare_view(Command& command, RenderRequest& r) {
    command.option("scene", &r.scene, "Scene: .gltf, .glb, .obj, .ply, .stl or .toml",
                   {.value = "SCENE", .required = true});
    command.option("--size", &r.size, "Pixels, for example 640x480 (the scene's, else 800x600)",
                   {.value = "WxH"});
    command.option("--camera", &r.choices.camera,
                   "Camera of the scene, by name or number (the first)");
    declare_light(command, r);
}

void declare_picture(Command& command, RenderRequest& r) {
    command.option("-o,--output", &r.outputs,
                   "Picture to write, .png or .exr, or - for a PNG to standard output;\n"
                   "may be given several times (SCENE.png in the current folder)",
                   {.value = "FILE"});
    command.option("--spp", &r.choices.samples, "Samples per pixel (the scene's, else 64)",
                   {.value = "N"});
    command.option("--time", &r.choices.seconds, "Stop a picture after about that many seconds",
                   {.value = "SECONDS"});
    command.option("--noise", &r.choices.noise,
                   "Render until each pixel is, with 95 % probability, off by no more than this\n"
                   "share of white as it is shown, for example 0.02; --spp is the most then (off)",
                   {.value = "ERROR"});
    command.option(
        "--aov", &r.aovs,
        "Further channels: in an .exr beside the picture's own, to OUTPUT.WORD.png of a\n"
        ".png; docs/scene-format.md says what each holds (the scene's)",
        {.value = "WORD", .delimiter = ',', .words = aov_words()});
    command.option(
        "--clamp", &r.choices.clamp,
        "The most radiance of a sample: fewer specks, less light; says how much less (the "
        "scene's, else any)",
        {.value = "RADIANCE"});
    declare_denoiser(command, r);
    declare_display(command, r);
    command.choice(
        "--exr-names", r.exr_names,
        "How the channels of an .exr are called: albedo.R, or as Blender has it (plain)");
    command.flag("--float", r.full_float, "Write 32-bit .exr instead of 16-bit");
}

void declare_film(Command& command, RenderRequest& r) {
    command.option("--film", &r.film,
                   "Film file to write, .exr of 32 bits, to go on from or to join with others; at\n"
                   "the end and when interrupted. Without -o there is no picture then",
                   {.value = "FILE"});
    command.option("--checkpoint", &r.checkpoint,
                   "Write the film every so many seconds too, while the picture goes on",
                   {.value = "SECONDS"});
    command.option("--resume", &r.resume,
                   "Go on from this film file; without --film that one is written again",
                   {.value = "FILE"});
    command.option("--samples", &r.sample_range,
                   "Only samples A to B - 1 of the picture's --spp; multiples of 64, or its last",
                   {.value = "A:B"});
    command.option("--rectangle", &r.rectangle,
                   "Only the pixels of this rectangle; the others stay black",
                   {.value = "X,Y,W,H"});
}

void declare_estimator(Command& command, RenderRequest& r) {
    command.choice("--integrator", r.choices.integrator,
                   "What is computed (the scene's, else path)");
    command.option("--depth", &r.choices.depth,
                   "The most surfaces a path visits (the scene's, else 12; 8 of ray trees)",
                   {.value = "N"});
    command.option("--seed", &r.choices.seed, "Of the random numbers; same seed, same picture (0)",
                   {.value = "N"});
    command.choice("--filter", r.choices.filter, "Pixel filter (blackman-harris)");
    command.choice("--bvh", r.bvh.builder,
                   "Tree of boxes: fast to build (sah), fast to traverse (high), or a plain one to "
                   "compare with");
    command.choice("--layout", r.layout,
                   "How the tree lies in memory (wide on CPUs, measured once on others)");
    command.flag("--watertight", r.bvh.watertight,
                 "Let no ray slip between triangles that share an edge or a corner");
}

void declare_engine(Command& command, RenderRequest& r) {
    command.choice("--engine", r.choices.engine,
                   "How paths are driven through the device (wavefront)");
    command.choice("--launch", r.choices.launch,
                   "Wavefront stages one by one, or all in one kernel (what suits the device)");
    command.choice("--interleave", r.choices.interleave, SWITCH,
                   "Rays of late bounces interleaved (where the BVH is larger than the cache)");
    command.option("--lanes", &r.choices.lanes, "Paths shaded at once by a work item: 1, 8 or 16",
                   {.value = "N"});
    command.option("--wave-size", &r.choices.wave_size, "Paths in flight", {.value = "N"});
    command.option("--chunk", &r.choices.chunk, "Paths of one work item", {.value = "N"});
}

void declare_sequence(Command& command, RenderRequest& r) {
    command.option("--turntable", &r.turntable,
                   "Render N pictures of the camera around the vertical axis of the scene,\n"
                   "OUTPUT.0001.png and on; # signs in OUTPUT stand for the digits",
                   {.value = "N", .least = 1, .most = MOST_PICTURES});
    command.option("--frames", &r.frames,
                   "Render these frames of a glTF file's animation, OUTPUT.0000.png and on",
                   {.value = "FIRST:LAST"});
    command.option("--fps", &r.frames_a_second, "Frames a second of --frames (24)", {.value = "N"});
}

void declare_reports(Command& command, RenderRequest& r) {
    command.flag("--stats", r.stats, "Print times, rays, memory and kernel times");
    command.option("--json", &r.json,
                   "Write the same numbers to this file, or - for standard output",
                   {.value = "FILE"});
    command.flag("--quiet", r.quiet, "Print warnings and errors only");
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

/// Of a request's outputs: each can be written, and goes to a place of its own.
class OutputCheck {
  public:
    void check(const fs::path& path) {
        writable_.check(path);
        std::error_code ignored;
        const bool standard = is_standard_output(path);
        // Devices and pipes may take several.
        if (!standard && fs::is_other(path, ignored)) return;
        if (!taken_.insert(standard ? STANDARD_OUTPUT : place_of(path)).second)
            throw InputError("{}: two outputs cannot go to the same place; name another",
                             standard ? "standard output" : path.string());
    }

  private:
    /// Behind its links. Of what is new in a folder that is known, the name is enough.
    fs::path place_of(const fs::path& path) {
        std::error_code ignored;
        if (fs::exists(fs::symlink_status(path, ignored)))
            return fs::weakly_canonical(fs::absolute(path), ignored);
        const auto [folder, is_new] = folders_.try_emplace(path.parent_path());
        if (is_new)
            folder->second = fs::weakly_canonical(fs::absolute(path).parent_path(), ignored);
        return folder->second / path.filename();
    }

    WritableCheck writable_;
    std::set<fs::path> taken_;
    std::map<fs::path, fs::path> folders_; ///< of new files, with where they really are
};

} // namespace

void declare_light(Command& command, RenderRequest& r) {
    command.option("--environment", &r.environment,
                   "Light the scene with this equirectangular picture (.hdr, .exr)",
                   {.value = "FILE"});
    command.option("--environment-rotation", &r.environment_rotation,
                   "Turn that picture, counter-clockwise seen from above", {.value = "DEGREES"});
    command.choice("--studio", r.studio,
                   "Light of soft boxes for files without an environment (for models and what is "
                   "dark else)");
    command.choice(
        "--ground", r.ground,
        "A plane under the scene that shows only its shadow and reflection (for models)");
}

void declare_display(Command& command, RenderRequest& r) {
    command.option("--exposure", &r.exposure, "Brighten the .png by that many stops",
                   {.value = "STOPS"});
    command.choice("--tone-map", r.tone_map,
                   "How bright light is shown in the .png (the scene's, else neutral; none for the "
                   "chapter's integrators)");
    command.choice("--background", r.choices.background,
                   "What is behind the scene; transparent gives the picture an alpha channel, "
                   "multiplied in .exr, straight in .png (environment)");
}

void declare_denoiser(Command& command, RenderRequest& r) {
    command.choice_or_alone(
        "--denoise", r.denoise, Denoiser::automatic,
        "Take the noise from the picture: by Open Image Denoise where its "
        "library is found,\nelse our own denoiser; alone it means auto (the scene's, "
        "else off)");
    command.option("--denoiser-library", &r.denoiser.library,
                   "libOpenImageDenoise.so.2, or a folder that has it (that of Python's pyoidn, or "
                   "the system's)",
                   {.value = "PATH"});
    command.choice("--denoise-quality", r.denoiser.quality,
                   "What guides Open Image Denoise is denoised first, which takes 7 times as long, "
                   "or is not (high)");
}

void declare_machine(Command& command, MachineRequest& r) {
    command.option(
        "--device", &r.device,
        "Device by number or part of its name (see onde devices); to render by several:\n"
        "all, or a list such as 0,2; 0/2 is device 0 in two parts");
    command.option("--kernels", &r.kernels, "Read kernels from this folder (live editing)",
                   {.value = "DIR"});
    command.flag("--no-cache", r.no_cache, "Compile kernels anew");
}

void declare_options(Command& command, RenderRequest& request) {
    declare_view(command, request);
    declare_load(command, request.load);
    declare_picture(command, request);
    declare_sequence(command, request);
    declare_film(command, request);
    declare_estimator(command, request);
    declare_engine(command, request);
    declare_machine(command, request.machine);
    command.flag("--mixed-devices", request.mixed_devices,
                 "Let devices of several classes share a picture: its bits then depend on which of "
                 "them took what");
    declare_reports(command, request);
}

void declare_mpi(Command& command, RenderRequest& r) {
    command.flag("--mpi", r.mpi,
                 "Render with the other ranks of the job that mpirun started: mpirun -n 8 onde "
                 "render --mpi ...");
    command.option("--parts", &r.parts,
                   "Folder that all ranks see, from which a job that died goes on (OUTPUT.parts)",
                   {.value = "DIR"});
}

void declare_replay_options(Command& command, RenderRequest& request) {
    declare_view(command, request);
    declare_load(command, request.load);
    declare_estimator(command, request);
    declare_machine(command, request.machine);
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
    return load_scene(request.scene, requested_load(request));
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
    const ResolvedOptions resolved = resolve_options(choices, scene, machine.device.facts());
    scene.notes.insert(scene.notes.end(), resolved.notes.begin(), resolved.notes.end());
    SessionOptions options{.render = resolved.options, .bvh = request.bvh};
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

std::filesystem::path aov_path(const std::filesystem::path& output, const std::string& name) {
    std::filesystem::path path = output;
    return path.replace_extension(name + output.extension().string());
}

bool is_exr(const std::filesystem::path& output) {
    return lower_extension(output) == ".exr";
}

std::vector<fs::path> named_outputs(const RenderRequest& request) {
    std::vector<fs::path> outputs = request.outputs;
    if (outputs.empty() && film_path(request).empty())
        outputs.push_back(request.scene.stem().string() + ".png");
    for (const fs::path& path : outputs) {
        if (is_standard_output(path) && !request.aovs.empty())
            throw InputError("--aov needs a file to name its pictures after; give one with -o");
        if (!is_standard_output(path) && lower_extension(path) != ".png" && !is_exr(path))
            throw InputError("{}: pictures are written as .png or .exr; change the extension",
                             path.string());
    }
    return outputs;
}

/// Files of AOVs are called so; each group of lights has one.
static std::vector<std::string> companions_of(const std::vector<std::string>& aovs,
                                              const Scene& scene) {
    std::vector<std::string> names;
    for (const std::string& aov : aovs) {
        if (aov != LIGHT_GROUPS) names.push_back(aov);
        if (aov == LIGHT_GROUPS)
            for (const std::string& group : light_groups(scene))
                names.push_back(group_layer(group));
    }
    return names;
}

/// These, what is written beside them, and the report.
static std::vector<fs::path> all_outputs(const std::vector<fs::path>& outputs,
                                         const RenderRequest& request,
                                         const std::vector<std::string>& companions) {
    std::vector<fs::path> all = outputs;
    for (const fs::path& output : outputs)
        if (!is_exr(output) && !is_standard_output(output))
            for (const std::string& name : companions) all.push_back(aov_path(output, name));
    if (!request.json.empty()) all.push_back(request.json);
    return all;
}

void check_outputs(const std::vector<fs::path>& outputs, const RenderRequest& request) {
    OutputCheck check;
    for (const fs::path& path : all_outputs(outputs, request, request.aovs)) check.check(path);
}

void check_outputs_not_read(const std::vector<fs::path>& outputs, const RenderRequest& request,
                            const Scene& scene) {
    std::vector<fs::path> files = scene.files;
    if (!request.environment.empty()) files.emplace_back(request.environment);
    const std::vector<std::string> aovs = requested_aovs(request, scene);
    OutputCheck check;
    for (const fs::path& path : all_outputs(outputs, request, companions_of(aovs, scene))) {
        check.check(path); // those that only the scene names too
        check_not_read(path, files);
    }
}

} // namespace onde::app
