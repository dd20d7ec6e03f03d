#include "app/render_command.h"

#include "app/film_keeper.h"
#include "app/picture.h"
#include "app/picture_files.h"
#include "app/rank_render.h"
#include "app/render_report.h"
#include "app/sequence.h"

#include "core/files.h"
#include "core/log.h"
#include "core/output.h"
#include "core/timer.h"
#include "mpi/mpi_ranks.h"
#include "scene/load.h"

#include <algorithm>
#include <cstdio>
#include <memory>
#include <utility>

namespace onde::app {
namespace {

void tell_findings(const DeviceGroup& devices, const RenderOutcome& outcome) {
    if (const Film::Invalid invalid = devices.find_invalid(); invalid.count > 0)
        spdlog::warn("{} samples were not finite and were left out; the first was sample {} of "
                     "pixel {},{}; please report the scene",
                     invalid.count, invalid.sample, invalid.x, invalid.y);
    for (const std::string& finding : devices.session().findings()) spdlog::info("{}", finding);
    // Several devices keep whole blocks.
    const char* least = devices.size() > 1 ? "64 samples of all pixels" : "sample";
    if (outcome.samples == 0)
        spdlog::warn("interrupted before the first {}; no picture was written", least);
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

/// What becomes of a request.
struct Work {
    const RenderRequest& request;
    StopOnInterrupt interrupt{}; ///< what is rendered is saved, while it is written too
    Outputs outputs{};
    std::vector<Json> reports{}; ///< of the pictures, where they are asked for
    size_t done = 0;             ///< pictures with all of their samples
    bool interrupted = false;
};

/// Renders what the devices show, and writes it. `timer` runs since the work on it began.
void make_picture(DeviceGroup& devices, const Shot& shot, RenderReport report, const Timer& timer,
                  Work& work) {
    const RenderRequest& request = work.request;
    FilmKeeper keeper(devices, shot, request.checkpoint);
    report.kernels_before = devices.kernel_times();
    report.outcome = render_until_done(devices, shot.name, work.interrupt, request.quiet,
                                       [&] { keeper.keep_if_due(); });
    tell_findings(devices, report.outcome);
    work.interrupted = report.outcome.interrupted || report.outcome.samples == 0;
    if (report.outcome.samples == 0) return;

    work.outputs.attempt([&] { keeper.keep(); });
    Session& session = devices.session();
    const ShownPicture shown = shown_picture(session, work.outputs);
    report.denoiser = shown.denoiser;
    report.denoise_seconds = shown.seconds;
    const Timer writing;
    write_picture_files(shot.outputs, work.outputs, session, request, shown,
                        picture_metadata(session, report.scene_hash, report.outcome));
    work.done += !work.interrupted;
    report.write_seconds = writing.seconds();
    report.total_seconds = timer.seconds();
    if (request.stats) print_report(devices, report, stream_for_words(request));
    if (!request.json.empty()) work.reports.push_back(report_json(devices, report));
}

/// Makes one picture after the other until one fails or the user has had enough.
void make_pictures(ShotSession& sessions, const std::vector<Shot>& shots, Timer timer, Work& work) {
    bool told = false;
    for (const Shot& shot : shots) {
        DeviceGroup& devices = sessions.show(shot);
        RenderReport report{.scene = work.request.scene.string(),
                            .scene_hash = scene_hash(devices.session().scene()),
                            .outputs = shot.outputs,
                            .at = shot.at,
                            .load_seconds = sessions.take_load_seconds()};
        work.interrupted = work.interrupt.requested() && told;
        if (work.interrupted) return;
        check_film(devices, shot);
        const gpu::BuildReport kernels = devices.prepare();
        if (report.load_seconds > 0) report.kernels = kernels;
        if (!told || !report.kernels.from_cache)
            tell_kernels(devices.session(), kernels, devices.size());
        told = true;
        make_picture(devices, shot, std::move(report), timer, work);
        if (work.interrupted || work.outputs.any_failed()) return;
        timer = Timer();
    }
}

/// Of a sequence that was interrupted, be it between two pictures.
void tell_where_it_stopped(const Work& work, size_t pictures) {
    if (work.interrupted && is_sequence(work.request))
        spdlog::warn("interrupted with {} of {} pictures done", work.done, pictures);
}

/// The one picture's report as it is, those of a sequence in a list.
void write_reports(bool is_sequence, Work& work) {
    if (work.reports.empty()) return;
    const Json json = is_sequence ? Json{{"pictures", work.reports}} : work.reports.front();
    work.outputs.attempt([&] { write_file(work.request.json, json_text(json)); });
}

/// A rank's part of one picture, which rank 0 writes; returns whether it was interrupted.
bool run_as_rank(RenderRequest request) {
    const Timer timer;
    const std::unique_ptr<Ranks> ranks = join_mpi_job();
    const bool writes = ranks->rank() == 0;
    request.parts = parts_folder(request);
    request.choices.noise = 0; // the scene's is left out
    const std::vector<Shot> shots =
        writes ? resolve_shots(request) : std::vector<Shot>(1); // others write parts only
    const Machines machines = open_machine_of_rank(request, *ranks);
    ShotSession sessions(machines, request, shots);
    Work work{request};
    work.interrupted =
        render_by_ranks(sessions.show(shots.front()).session(), request, *ranks, work.interrupt);
    if (work.interrupted) { // which ends the other ranks
        spdlog::warn("interrupted; the same command goes on from {}", request.parts.string());
        return true;
    }
    if (writes) {
        make_pictures(sessions, shots, timer, work);
        work.outputs.check();
        remove_parts(request);
    }
    ranks->finish();
    return work.interrupted;
}

/// Renders one request; returns whether it was interrupted.
bool run(const RenderRequest& request) {
    set_up_logging(request.quiet);
    const Timer timer;
    check_request(request);
    check_mpi_request(request);
    if (request.mpi) return run_as_rank(request);
    const std::vector<Shot> shots = resolve_shots(request);
    const bool timed = request.stats || !request.json.empty();
    const Machines machines =
        open_machines(request, timed ? gpu::Profiling::on : gpu::Profiling::off);
    ShotSession sessions(machines, request, shots);
    Work work{request}; // from here on signals are caught
    make_pictures(sessions, shots, timer, work);
    tell_where_it_stopped(work, shots.size());
    write_reports(is_sequence(request), work);
    work.outputs.check();
    return work.interrupted;
}

} // namespace

void add_render_command(Command& root, bool& interrupted) {
    const auto request = std::make_shared<RenderRequest>(); // what runs later is copied
    Command command = root.add_command("render", "Render a scene to a picture");
    declare_options(command, *request);
    declare_mpi(command, *request);
    command.on_run([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
