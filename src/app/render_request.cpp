#include "app/render_request.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/frame.h"
#include "scene/load.h"
#include "upload/layout_choice.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace onde::app {
namespace {

/// As in scene files.
constexpr float MOST_STOPS = 64.0f;

const std::map<std::string, bool> AOVS{{"tests", true}};
const std::map<std::string, bool> SWITCH{{"on", true}, {"off", false}};

std::pair<uint32_t, uint32_t> parse_size(const std::string& text) {
    if (const auto size = parse_pair(text, 'x')) return *size;
    throw InputError("--size {} is not of the form WIDTHxHEIGHT, for example 640x480", text);
}

uint32_t find_camera(const std::string& name, const Scene& scene) {
    if (name.empty()) return 0;
    std::vector<std::string> names;
    for (uint32_t i = 0; i < scene.cameras.size(); i++) {
        if (scene.cameras[i].name == name || std::to_string(i) == name) return i;
        names.push_back(fmt::format("{} \"{}\"", i, scene.cameras[i].name));
    }
    throw InputError("--camera {}: no such camera; the scene has {}", name, fmt::join(names, ", "));
}

void declare_view(Command& command, RenderRequest& r) {
    command.option("scene", &r.scene, "Scene: .gltf, .glb, .obj, .ply or .toml",
                   {.value = "SCENE", .required = true});
    command.option("--size", &r.size, "Pixels, for example 640x480 (the scene's, else 800x600)",
                   {.value = "WxH"});
    command.option("--camera", &r.camera, "Camera of the scene, by name or number (the first)");
    command.option("--environment", &r.environment,
                   "Light the scene with this equirectangular picture (.hdr, .exr)",
                   {.value = "FILE"});
    command.option("--environment-rotation", &r.environment_rotation,
                   "Turn that picture, counter-clockwise seen from above", {.value = "DEGREES"});
}

void declare_picture(Command& command, RenderRequest& r) {
    command.option("-o,--output", &r.outputs,
                   "Picture to write, .png or .exr; may be given several times\n"
                   "(SCENE.png in the current folder)",
                   {.value = "FILE"});
    command.option("--spp", &r.samples, "Samples per pixel (the scene's, else 64)", {.value = "N"});
    command.option("--time", &r.seconds, "Stop after about that many seconds",
                   {.value = "SECONDS"});
    command.option("--exposure", &r.exposure, "Brighten the .png by that many stops",
                   {.value = "STOPS"});
    command.choice("--tone-map", r.tone_map, "How the .png rolls off highlights (none)");
    command.choice("--aov", r.cost_aov, AOVS,
                   "Also write OUTPUT.tests: boxes and primitives that each pixel's camera ray "
                   "tests,\nas numbers in .exr, as colours in .png");
    command.flag("--float", r.full_float, "Write 32-bit .exr instead of 16-bit");
}

void declare_estimator(Command& command, RenderRequest& r) {
    command.choice("--integrator", r.integrator, "What is computed (the scene's, else path)");
    command.option("--depth", &r.depth, "The most surfaces a path visits (the scene's, else 8)",
                   {.value = "N"});
    command.option("--seed", &r.seed, "Of the random numbers; same seed, same picture (0)",
                   {.value = "N"});
    command.choice("--filter", r.filter, "Pixel filter (blackman-harris)");
    command.choice("--bvh", r.bvh.builder,
                   "Tree of boxes: fast to build (sah), fast to walk (high), or a plain one to "
                   "compare with");
    command.choice("--layout", r.layout,
                   "How the tree lies in memory (wide on CPUs, measured once on others)");
    command.flag("--watertight", r.bvh.watertight,
                 "Let no ray slip between triangles that share an edge or a corner");
}

void declare_engine(Command& command, RenderRequest& r) {
    command.choice("--engine", r.engine, "How paths are driven through the device (wavefront)");
    command.choice("--launch", r.launch,
                   "Wavefront stages one by one, or all in one kernel\n(this and the next: what "
                   "suits the device)");
    command.choice("--queue", r.queue, "Where live rays are kept");
    command.choice("--packets", r.packets, SWITCH, "Primary rays in packets of 16");
    command.choice("--interleave", r.turns, SWITCH,
                   "Rays of late bounces in turns (where the tree is larger than the cache)");
    command.option("--lanes", &r.width, "Paths shaded at once by a work item: 1, 8 or 16",
                   {.value = "N"});
    command.option("--wave-size", &r.wave_size, "Paths in flight", {.value = "N"});
    command.option("--chunk", &r.chunk, "Paths of one work item", {.value = "N"});
    command.option("--tree-slots", &r.tree_slots,
                   "Whitted: rays kept for each path of a wave (8); what does not fit is cut",
                   {.value = "N"});
}

void declare_reports(Command& command, RenderRequest& r) {
    command.flag("--stats", r.stats, "Print times, rays, memory and kernel times");
    command.option("--json", &r.json, "Write the same numbers to this file", {.value = "FILE"});
    command.flag("--quiet", r.quiet, "Print warnings and errors only");
}

/// The request's depth, or the scene's as far as an integrator that it does not ask for takes it.
uint32_t resolve_depth(const RenderRequest& request, const RenderSettings& own,
                       const RenderOptions& options) {
    if (request.depth) return *request.depth;
    const uint32_t depth = own.depth.value_or(options.depth), most = most_depth(options.integrator);
    const bool is_own = options.integrator == own.integrator.value_or(IntegratorKind::path);
    if (is_own || depth <= most) return depth;
    spdlog::info("the scene's depth of {} was cut to {}, the most that --integrator {} takes",
                 depth, most, word_of(options.integrator));
    return most;
}

/// Waves are rounded up to whole chunks.
void resolve_settings(const RenderRequest& request, gpu::DeviceSettings& settings) {
    settings.width = request.width.value_or(settings.width);
    settings.queue = request.queue.value_or(settings.queue);
    if (settings.queue == gpu::QueueKind::global) settings.launch = gpu::Launch::staged;
    settings.launch = request.launch.value_or(settings.launch);
    settings.primary_packets = request.packets.value_or(settings.primary_packets);
    if (request.turns) settings.interleave_above = *request.turns ? 0 : UINT64_MAX;
    settings.chunk = request.chunk.value_or(std::max(settings.chunk, settings.width));
    settings.wave_size = request.wave_size.value_or(settings.wave_size);
    if (settings.chunk == 0) return;
    const uint64_t chunks = (uint64_t(settings.wave_size) + settings.chunk - 1) / settings.chunk;
    settings.wave_size = uint32_t(std::min<uint64_t>(chunks * settings.chunk, UINT32_MAX));
}

} // namespace

void declare_machine(Command& command, MachineRequest& r) {
    command.option("--device", &r.device,
                   "Device by number or part of its name (see onde devices)");
    command.option("--kernels", &r.kernels, "Read kernels from this folder (live editing)",
                   {.value = "DIR"});
    command.flag("--no-cache", r.no_cache, "Compile kernels anew");
}

void declare_options(Command& command, RenderRequest& request) {
    declare_view(command, request);
    declare_picture(command, request);
    declare_estimator(command, request);
    declare_engine(command, request);
    declare_machine(command, request.machine);
    declare_reports(command, request);
}

void declare_replay_options(Command& command, RenderRequest& request) {
    declare_view(command, request);
    declare_estimator(command, request);
    declare_machine(command, request.machine);
}

Scene load_requested_scene(const RenderRequest& request) {
    if (request.environment.empty()) return load_scene(request.scene);
    return load_scene(request.scene, load_environment(request.environment, glm::vec3(1.0f),
                                                      request.environment_rotation));
}

void check_request(const RenderRequest& r) {
    if (!r.size.empty()) parse_size(r.size);
    // "nan" and "inf" are read as numbers.
    if (r.seconds && !(*r.seconds > 0 && std::isfinite(*r.seconds)))
        throw InputError("--time {} is not a positive number of seconds", *r.seconds);
    if (r.exposure && !(std::abs(*r.exposure) <= MOST_STOPS))
        throw InputError("--exposure {} is out of range; use {} to {} stops", *r.exposure,
                         -MOST_STOPS, MOST_STOPS);
    if (!std::isfinite(r.environment_rotation))
        throw InputError("--environment-rotation {} is not a number of degrees",
                         r.environment_rotation);
}

RenderOptions resolve_options(const RenderRequest& request, const Scene& scene,
                              const gpu::DeviceFacts& facts) {
    const RenderSettings& own = scene.settings;
    RenderOptions options;
    options.width = own.width.value_or(options.width);
    options.height = own.height.value_or(options.height);
    if (!request.size.empty()) std::tie(options.width, options.height) = parse_size(request.size);
    options.seconds = request.seconds.value_or(0);
    const uint32_t by_default = options.seconds > 0 ? 1u << 20 : options.samples;
    options.samples = request.samples.value_or(
        options.seconds > 0 ? by_default : own.samples.value_or(by_default));
    options.seed = request.seed.value_or(own.seed.value_or(options.seed));
    options.filter = request.filter.value_or(own.filter.value_or(options.filter));
    options.camera = find_camera(request.camera, scene);
    if (!scene.cameras.empty())
        check_screen(scene.cameras[options.camera], options.width, options.height);
    options.integrator = request.integrator.value_or(own.integrator.value_or(options.integrator));
    options.depth = resolve_depth(request, own, options);
    options.tree_slots = request.tree_slots.value_or(options.tree_slots);
    options.engine = request.engine.value_or(options.engine);
    options.settings = gpu::default_settings(facts);
    resolve_settings(request, options.settings);
    check_options(options);
    return options;
}

BvhOptions resolve_bvh(const RenderRequest& request, gpu::Programs& programs) {
    BvhOptions options = request.bvh;
    options.layout = request.layout ? *request.layout : suitable_layout(programs);
    return options;
}

std::filesystem::path aov_path(const std::filesystem::path& output, const std::string& name) {
    std::filesystem::path path = output;
    return path.replace_extension(name + output.extension().string());
}

std::vector<std::filesystem::path> resolve_outputs(const RenderRequest& request) {
    std::vector<std::filesystem::path> outputs = request.outputs;
    if (outputs.empty()) outputs.push_back(request.scene.stem().string() + ".png");
    for (const auto& path : outputs) {
        if (path.extension() != ".png" && path.extension() != ".exr")
            throw InputError("{}: pictures are written as .png or .exr; change the extension",
                             path.string());
        check_writable(path);
        if (request.cost_aov) check_writable(aov_path(path, "tests"));
    }
    if (!request.json.empty()) check_writable(request.json);
    return outputs;
}

} // namespace onde::app
