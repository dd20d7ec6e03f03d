#include "app/render_command.h"

#include "app/interrupt.h"
#include "app/progress_line.h"
#include "app/render_report.h"
#include "app/render_request.h"

#include "core/log.h"
#include "core/timer.h"
#include "render/memory_plan.h"
#include "render/traversal_cost.h"
#include "scene/load.h"
#include "scene/mapping.h"
#include "session/integrators.h"
#include "upload/device_scene.h"

#include <memory>

namespace onde::app {
namespace {

Scene load(const RenderRequest& request) {
    Scene scene = load_requested_scene(request);
    for (const std::string& note : scene.notes) spdlog::info("{}", note);
    return scene;
}

ImageMetadata describe_picture(const RenderReport& report) {
    return {{"onde:scene_hash", report.scene_hash},
            {"onde:seed", std::to_string(report.options.seed)},
            {"onde:samples", fmt::format("{:.6g}", report.outcome.samples)},
            {"onde:device", report.device.name},
            {"onde:version", ONDE_VERSION},
            {"Software", "Onde " ONDE_VERSION}};
}

void write_pictures(const std::vector<std::filesystem::path>& outputs, const Image& image,
                    const RenderRequest& request, const Scene& scene,
                    const ImageMetadata& metadata) {
    const Display display{request.exposure.value_or(scene.settings.exposure.value_or(0.0f)),
                          request.tone_map};
    const ExrDepth depth = request.full_float ? ExrDepth::full_float : ExrDepth::half_float;
    for (const auto& path : outputs) {
        if (path.extension() == ".exr")
            write_exr(path, image, metadata, depth);
        else
            write_png(path, image, display, metadata);
        spdlog::info("wrote {}", std::filesystem::absolute(path).string());
    }
}

void write_test_maps(const std::vector<std::filesystem::path>& outputs,
                     const IntegratorContext& context, const ImageMetadata& metadata) {
    const TraversalCost map = measure_traversal_cost(context);
    for (const auto& output : outputs) {
        const std::filesystem::path path = aov_path(output, "tests");
        if (path.extension() == ".exr")
            write_exr(path, cost_numbers(map), metadata, ExrDepth::full_float);
        else
            write_png(path, heat_picture(map), {}, metadata);
        spdlog::info("wrote {}", std::filesystem::absolute(path).string());
    }
    spdlog::info("{} tests of boxes and primitives by camera rays, {:.1f} per pixel, {} at most",
                 map.sum(), double(map.sum()) / (double(map.width) * map.height), map.largest());
}

void warn_of_invalid(const Film::Invalid& invalid) {
    if (invalid.count == 0) return;
    spdlog::warn("{} samples were not finite and were left out; the first was sample {} of pixel "
                 "{},{}; please report the scene",
                 invalid.count, invalid.sample, invalid.x, invalid.y);
}

RenderOutcome render_until_done(Integrator& integrator, const RenderReport& report, bool quiet) {
    const StopOnInterrupt interrupt;
    spdlog::info("rendering {}x{} on {}, kernels {} in {:.2f} s", report.options.width,
                 report.options.height, report.device.name,
                 report.kernels.from_cache ? "loaded" : "compiled", report.kernels.seconds);
    ProgressLine line(quiet);
    const RenderOutcome outcome = render(integrator, report.options, interrupt.requested(),
                                         [&](const Progress& progress) { line.show(progress); });
    line.finish();
    return outcome;
}

/// Renders one request; returns whether it was interrupted.
bool run(const RenderRequest& request) {
    set_up_logging(request.quiet);
    const Timer total;
    RenderReport report;
    check_request(request);
    const auto outputs = resolve_outputs(request);
    gpu::KernelSources sources = request.machine.sources();
    const bool profiled = request.stats || !request.json.empty();
    const gpu::Device device = gpu::open_device(
        request.machine.device, profiled ? gpu::Profiling::on : gpu::Profiling::off);
    gpu::Programs programs(device, std::move(sources), request.machine.cache());
    const Timer loading;
    const Scene scene = load(request);
    report.load_seconds = loading.seconds();
    report.device = device.facts();
    report.options = resolve_options(request, scene, device.facts());
    for (const std::string& note : mapping_notes(scene, report.options.integrator))
        spdlog::info("{}", note);
    report.scene = request.scene.string();
    report.scene_hash = scene_hash(scene);
    MemoryPlan plan = plan_memory(scene, report.options, device.facts());
    check_memory(plan, device.facts());

    const Timer packing;
    PackedScene packed = pack_scene(scene, resolve_bvh(request, programs));
    plan.add_scene(packed.device_buffers());
    check_memory(plan, device.facts());
    const DeviceScene device_scene(device, std::move(packed));
    report.pack_seconds = packing.seconds();
    report.layout = device_scene.packed().bvh.layout;
    report.bvh = device_scene.packed().bvh.statistics;
    report.scene_bytes = gpu::total_bytes(plan.scene);

    gpu::Profiler profiler;
    const IntegratorContext context{programs,       &scene,
                                    device_scene,   scene.cameras[report.options.camera],
                                    report.options, profiled ? &profiler : nullptr};
    const auto integrator = make_integrator(context);
    report.kernels = integrator->build_report();
    report.state_bytes = gpu::total_bytes(plan.paths);
    report.film_bytes = gpu::total_bytes(plan.film);
    report.outcome = render_until_done(*integrator, report, request.quiet);
    report.rays = integrator->ray_counts();
    report.invalid = integrator->film().find_invalid();
    warn_of_invalid(report.invalid);
    for (const std::string& finding : integrator->findings()) spdlog::info("{}", finding);
    if (report.outcome.samples == 0) {
        spdlog::warn("interrupted before the first sample; no picture was written");
        return true;
    }
    if (report.outcome.interrupted)
        spdlog::warn("interrupted after {:.3g} samples per pixel; saving the picture so far",
                     report.outcome.samples);

    const Timer writing;
    write_pictures(outputs, integrator->film().develop(), request, scene, describe_picture(report));
    if (request.cost_aov) write_test_maps(outputs, context, describe_picture(report));
    report.write_seconds = writing.seconds();
    report.total_seconds = total.seconds();
    if (profiled) report.kernel_times = profiler.totals();
    if (request.stats) print_report(report);
    if (!request.json.empty()) write_report(report, request.json);
    return report.outcome.interrupted;
}

} // namespace

void add_render_command(Command& root, bool& interrupted) {
    const auto request = std::make_shared<RenderRequest>(); // what runs later is copied
    Command command = root.add_command("render", "Render a scene to a picture");
    declare_options(command, *request);
    command.on_run([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
