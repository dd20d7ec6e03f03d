#include "app/work_command.h"

#include "app/film_request.h"
#include "app/motion_request.h"
#include "app/picture.h"
#include "app/picture_files.h"
#include "app/unit_renderer.h"

#include "core/error.h"
#include "core/log.h"
#include "core/output.h"
#include "core/timer.h"
#include "farm/work.h"
#include "film/merge.h"
#include "image/tone.h"

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <thread>

namespace onde::app {
namespace {

struct WorkRequest {
    std::filesystem::path store;
    RenderRequest render;
    uint32_t unit = FILM_BLOCK;
    std::string tiles;
    double lease = 600, verify = 0;
};

/// Options of renders that say what workers share out by themselves.
void check_work_request(const WorkRequest& r) {
    const RenderRequest& render = r.render;
    if (is_sequence(render))
        throw InputError("a store is of one picture; give each frame a store of its own");
    if (!render.film.empty() || !render.resume.empty() || render.checkpoint ||
        !render.sample_range.empty() || !render.rectangle.empty() || render.choices.seconds ||
        render.choices.noise.value_or(0) > 0)
        throw InputError("workers share out samples and pixels by themselves; leave out --film, "
                         "--resume, --checkpoint, --samples, --rectangle, --time and --noise");
    if (render.denoise.value_or(Denoiser::off) != Denoiser::off || render.stats ||
        !render.json.empty())
        throw InputError("workers only make a film and its picture; leave out --denoise, --stats "
                         "and --json, and give them to onde render --resume STORE/film.exr");
    check_request(render);
    check_frames_a_second(render);
    if (render.outputs.empty()) return;
    check_outputs(named_outputs(render), render);
}

WorkPlan plan_of(const WorkRequest& request, const FilmHeader& header) {
    WorkPlan plan{.header = header, .unit_samples = request.unit};
    if (request.tiles.empty()) return plan;
    const auto tiles = parse_pair(request.tiles, 'x', "--tiles");
    if (!tiles)
        throw InputError("--tiles {} is not of the form COLUMNSxROWS, for example 2x2",
                         request.tiles);
    std::tie(plan.columns, plan.rows) = *tiles;
    return plan;
}

void write_picture(const std::filesystem::path& path, const Session& session,
                   const RenderRequest& request, const std::filesystem::path& film) {
    FilmMerge merge({film});
    const Image picture = merge.picture();
    RenderOutcome outcome;
    outcome.samples = merge.samples();
    const ImageMetadata metadata =
        picture_metadata(session, merge.header().identity.scene, outcome);
    if (is_exr(path)) {
        const ExrContents all =
            film_contents(merge, picture, metadata, request.full_float, request.exr_names);
        write_exr(path, all.layers, all.metadata);
    } else {
        write_png(path, straight_alpha(picture), requested_display(session, request), metadata);
    }
    tell_written(path);
}

/// Works until the film is complete; returns whether it was interrupted.
bool work(Worker& worker, const StopOnInterrupt& interrupt) {
    constexpr auto PAUSE = std::chrono::milliseconds(200);
    while (!interrupt.requested()) {
        const Worker::Step step = worker.step();
        if (step == Worker::Step::done) return false;
        if (step == Worker::Step::interrupted) return true;
        if (step == Worker::Step::waiting) std::this_thread::sleep_for(PAUSE);
    }
    return true;
}

bool work_in(const Store& store, const WorkRequest& request) {
    Machine machine = open_machine(request.render.machine);
    RenderRequest own = request.render;
    own.choices.noise = 0; // the scene's is left out, and its denoiser
    own.denoise = Denoiser::off;
    Session session = open_session(machine, load_requested_scene(own), own);
    StopOnInterrupt interrupt;
    UnitRenderer renderer(session, request.render, interrupt);
    Worker worker(store, plan_of(request, renderer.header()), request.verify / 100,
                  [&](const Rectangle& window, std::pair<uint32_t, uint32_t> samples,
                      const std::filesystem::path& file, const std::function<void()>& renew) {
                      return renderer.render(window, samples, file, renew);
                  });
    const bool interrupted = work(worker, interrupt);
    spdlog::info("{} units rendered and {} pairs joined here", worker.rendered(), worker.joined());
    if (interrupted) return true;
    Outputs outputs;
    for (const auto& path : request.render.outputs)
        outputs.attempt([&] { write_picture(path, session, request.render, store.film()); });
    outputs.check();
    spdlog::info("the film is complete: {}", std::filesystem::absolute(store.film()).string());
    return false;
}

bool run_work(const WorkRequest& request) {
    set_up_logging(request.render.quiet);
    check_work_request(request);
    const Store store(request.store, request.lease);
    try {
        return work_in(store, request);
    } catch (...) {
        store.remove_if_unused();
        throw;
    }
}

} // namespace

void add_work_command(Command& root, bool& interrupted) {
    Command command = root.add_command(
        "work", "Render a picture together with other workers, by a folder that all of them see");
    const auto request = std::make_shared<WorkRequest>(); // what runs later is copied
    command.option("store", &request->store, "The folder; the film is STORE/film.exr in the end",
                   {.value = "STORE", .required = true});
    command.option("--unit", &request->unit,
                   "Samples that a worker takes at once: 64, 128, 256, ...; the same for all",
                   {.value = "N", .show_default = true});
    command.option("--tiles", &request->tiles,
                   "Cut the picture in so many tiles too (1x1); the same for all",
                   {.value = "CxR"});
    command.option("--lease", &request->lease,
                   "A worker that gives no sign for so many seconds is given up",
                   {.value = "SECONDS", .show_default = true, .least = 5, .most = 1e6});
    command.option("--verify", &request->verify,
                   "Render that share of the units again and compare their bits (0)",
                   {.value = "PERCENT", .least = 0, .most = 100});
    declare_options(command, request->render);
    command.on_run([request, &interrupted] { interrupted = run_work(*request); });
}

} // namespace onde::app
