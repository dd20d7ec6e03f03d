#include "app/render_command.h"

#include "app/interrupt.h"
#include "app/progress_line.h"
#include "app/render_report.h"
#include "app/render_request.h"
#include "app/turntable.h"

#include "core/files.h"
#include "core/log.h"
#include "core/output.h"
#include "core/timer.h"
#include "image/tone.h"
#include "scene/load.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

namespace onde::app {
namespace {

ImageMetadata describe_picture(const Session& session, const RenderReport& report) {
    return {{"onde:scene_hash", report.scene_hash},
            {"onde:seed", std::to_string(session.options().seed)},
            {"onde:samples", fmt::format("{:.6g}", report.outcome.samples)},
            {"onde:device", session.device().facts().name},
            {"onde:version", ONDE_VERSION},
            {"Software", "Onde " ONDE_VERSION}};
}

/// One picture in every file that is asked for: `as_exr` and `as_png` write it to a path.
template <class WriteExr, class WritePng>
void write_each(const std::vector<std::filesystem::path>& paths, Outputs& outputs, WriteExr as_exr,
                WritePng as_png) {
    for (const auto& path : paths)
        outputs.attempt([&] {
            is_exr(path) ? as_exr(path) : as_png(path);
            if (!is_standard_output(path))
                spdlog::info("wrote {}", std::filesystem::absolute(path).string());
        });
}

void write_pictures(const std::vector<std::filesystem::path>& paths, Outputs& outputs,
                    const Image& image, const RenderRequest& request, const Display& display,
                    const ImageMetadata& metadata) {
    const ExrDepth depth = request.full_float ? ExrDepth::full_float : ExrDepth::half_float;
    write_each(
        paths, outputs, [&](const auto& path) { write_exr(path, image, metadata, depth); },
        [&](const auto& path) { write_png(path, straight_alpha(image), display, metadata); });
}

void write_cost_maps(const std::vector<std::filesystem::path>& paths, Outputs& outputs,
                     const TraversalCost& map, const ImageMetadata& metadata) {
    write_each(
        aov_paths(paths, TRAVERSAL_COST), outputs,
        [&](const auto& path) {
            write_exr(path, cost_numbers(map), metadata, ExrDepth::full_float);
        },
        [&](const auto& path) { write_png(path, heat_picture(map), {}, metadata); });
    spdlog::info("{} tests of boxes and primitives by camera rays, {:.1f} per pixel, {} at most",
                 map.sum(), double(map.sum()) / (double(map.width) * map.height), map.largest());
}

/// A channel as it is seen: directions by their octant, colours as they are, others grey, where the
/// largest is white.
Image shown_channel(Image numbers, const FilmChannel& channel) {
    const bool is_direction = channel.sums == AOV_NORMAL;
    const float largest = channel.components == 3 ? 1.0f : std::ranges::max(numbers.pixels);
    for (float& number : numbers.pixels)
        number = is_direction ? linear_from_srgb(0.5f + 0.5f * number)
                              : number / std::max(largest, 1e-30f);
    return numbers;
}

/// The numbers of a channel of the film, or what is seen of it.
void write_channel(const std::vector<std::filesystem::path>& paths, Outputs& outputs,
                   const Image& numbers, const FilmChannel& channel,
                   const ImageMetadata& metadata) {
    write_each(
        aov_paths(paths, std::string(channel.name)), outputs,
        [&](const auto& path) { write_exr(path, numbers, metadata, ExrDepth::full_float); },
        [&](const auto& path) { write_png(path, shown_channel(numbers, channel), {}, metadata); });
}

void write_all(const std::vector<std::filesystem::path>& paths, Outputs& outputs, Session& session,
               const RenderRequest& request, const RenderReport& report) {
    Display display = display_of(session.scene().settings, session.options().integrator);
    display.exposure = request.exposure.value_or(display.exposure);
    display.tone_map = request.tone_map.value_or(display.tone_map);
    const ImageMetadata metadata = describe_picture(session, report);
    write_pictures(paths, outputs, session.picture(), request, display, metadata);
    for (const std::string& aov : request.aovs)
        if (aov == TRAVERSAL_COST)
            write_cost_maps(paths, outputs, session.traversal_cost(), metadata);
        else
            write_channel(paths, outputs, session.film().develop(*find_channel(aov)),
                          *find_channel(aov), metadata);
}

RenderOutcome render_until_done(Session& session, RenderReport& report,
                                const StopOnInterrupt& interrupt, bool quiet) {
    const gpu::BuildReport& kernels = session.prepare();
    if (std::exchange(report.kernel_seconds, kernels.seconds) != kernels.seconds)
        spdlog::info("rendering {}x{} on {}, kernels {} in {:.2f} s", session.options().width,
                     session.options().height, session.device().facts().name,
                     kernels.from_cache ? "loaded" : "compiled", kernels.seconds);
    ProgressLine line(quiet);
    const RenderOutcome outcome = session.render([&](const Progress& progress) {
        line.show(progress);
        return !interrupt.requested();
    });
    line.finish();
    return outcome;
}

void tell_findings(Session& session, const RenderOutcome& outcome) {
    if (const Film::Invalid invalid = session.film().find_invalid(); invalid.count > 0)
        spdlog::warn("{} samples were not finite and were left out; the first was sample {} of "
                     "pixel {},{}; please report the scene",
                     invalid.count, invalid.sample, invalid.x, invalid.y);
    for (const std::string& finding : session.findings()) spdlog::info("{}", finding);
    if (outcome.samples == 0)
        spdlog::warn("interrupted before the first sample; no picture was written");
    else if (outcome.interrupted)
        spdlog::warn("interrupted after {:.3g} samples per pixel; saving the picture so far",
                     outcome.samples);
}

/// Standard output, unless a picture or the JSON goes there.
std::FILE* stream_for_words(const RenderRequest& request) {
    const bool taken = is_standard_output(request.json) ||
                       std::ranges::any_of(request.outputs, is_standard_output);
    return taken ? stderr : stdout;
}

/// Renders what the session shows now, and writes it; returns whether it was interrupted.
bool make_picture(Session& session, const RenderRequest& request,
                  const std::vector<std::filesystem::path>& paths, RenderReport& report,
                  const Timer& total, const StopOnInterrupt& interrupt) {
    report.outcome = render_until_done(session, report, interrupt, request.quiet);
    tell_findings(session, report.outcome);
    if (report.outcome.samples == 0) return true;

    const Timer writing;
    Outputs outputs;
    write_all(paths, outputs, session, request, report);
    report.write_seconds = writing.seconds();
    report.total_seconds = total.seconds();
    if (request.stats) print_report(session, report, stream_for_words(request));
    if (!request.json.empty())
        outputs.attempt([&] { write_report(session, report, request.json); });
    outputs.check();
    return report.outcome.interrupted;
}

/// Renders one request; returns whether it was interrupted.
bool run(const RenderRequest& request) {
    set_up_logging(request.quiet);
    const Timer total;
    RenderReport report{.scene = request.scene.string()};
    check_request(request);
    const auto pictures = resolve_pictures(request);
    const bool timed = request.stats || !request.json.empty();
    Machine machine =
        open_machine(request.machine, timed ? gpu::Profiling::on : gpu::Profiling::off);
    const Timer loading;
    Scene scene = load_requested_scene(request);
    report.load_seconds = loading.seconds();
    Session session = open_session(machine, std::move(scene), request);
    report.scene_hash = scene_hash(session.scene());
    const StopOnInterrupt interrupt; // what is rendered is saved, while it is written too
    const Camera camera = session.camera();
    const SceneBounds bounds = scene_bounds(session.scene());
    for (size_t i = 0; i < pictures.size(); ++i) {
        const double share = double(i) / double(pictures.size());
        if (i > 0) session.set_camera(turned_camera(camera, bounds, 2 * M_PI * share));
        if (make_picture(session, request, pictures[i], report, total, interrupt)) return true;
    }
    return false;
}

} // namespace

void add_render_command(Command& root, bool& interrupted) {
    const auto request = std::make_shared<RenderRequest>(); // what runs later is copied
    Command command = root.add_command("render", "Render a scene to a picture");
    declare_options(command, *request);
    command.on_run([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
