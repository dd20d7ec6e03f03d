#include "app/inspect_command.h"

#include "app/inspect_report.h"
#include "app/render_request.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "upload/device_scene.h"

#include <memory>

namespace onde::app {
namespace {

struct InspectRequest {
    RenderRequest render; ///< scene, size, depth, ...: as the picture was rendered
    std::string pixel;
    uint32_t sample = 0;
    std::filesystem::path dot;
};

PixelSample parse_pixel(const InspectRequest& request) {
    const auto pair = parse_pair(request.pixel, ',');
    if (!pair)
        throw InputError("--pixel {} is not of the form X,Y, for example 120,80", request.pixel);
    PixelSample at;
    std::tie(at.x, at.y) = *pair;
    at.sample = request.sample;
    return at;
}

void run(const InspectRequest& request) {
    set_up_logging(request.render.quiet);
    check_request(request.render);
    const PixelSample at = parse_pixel(request);
    if (!request.dot.empty()) check_writable(request.dot);
    gpu::KernelSources sources = request.render.machine.sources();
    const gpu::Device device = gpu::open_device(request.render.machine.device);
    gpu::Programs programs(device, std::move(sources), request.render.machine.cache());
    const Scene scene = load_requested_scene(request.render);
    const RenderOptions options = resolve_options(request.render, scene, device.facts());
    const BvhOptions tree = resolve_bvh(request.render, programs);
    const DeviceScene placed(device, pack_scene(scene, tree));
    const IntegratorContext context{programs, &scene, placed, scene.cameras.at(options.camera),
                                    options};
    std::string words, dot;
    if (options.integrator == IntegratorKind::whitted) {
        const TreeReport report = inspect_whitted(context, at);
        words = tree_text(report, scene, placed.packed());
        dot = tree_dot(report, scene);
    } else if (options.integrator == IntegratorKind::path) {
        const PathReport report = inspect_path(context, at);
        words = path_text(report, scene, placed.packed());
        dot = path_dot(report, scene);
    } else {
        throw InputError(
            "inspect follows --integrator path or whitted; this scene asks for another");
    }
    fmt::print("pixel {},{} of {}x{}, sample {}\n{}", at.x, at.y, options.width, options.height,
               at.sample, words);
    if (!request.dot.empty()) write_text(request.dot, dot);
}

} // namespace

void add_inspect_command(Command& root) {
    const auto request = std::make_shared<InspectRequest>(); // what runs later is copied
    Command command = root.add_command(
        "inspect", "Replay one sample of a pixel: its ray tree, or its path, in words");
    command.option("--pixel", &request->pixel, "From the upper left",
                   {.value = "X,Y", .required = true});
    command.option("--sample", &request->sample, "Of the pixel, from 0", {.value = "S"});
    command.option("--dot", &request->dot, "Write it as a graph for Graphviz too",
                   {.value = "FILE"});
    declare_replay_options(command, request->render);
    command.on_run([request] { run(*request); });
}

} // namespace onde::app
