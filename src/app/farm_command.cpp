#include "app/farm_command.h"

#include "app/job_files.h"
#include "app/json.h"

#include "core/error.h"
#include "core/log.h"
#include "core/output.h"
#include "farm/work.h"

#include <fmt/format.h>

#include <memory>

namespace onde::app {
namespace {

struct StatusRequest {
    std::filesystem::path store;
    bool json = false;
    double lease = 600;
};

void run_status(const StatusRequest& request) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(request.store / "notes", ignored))
        throw InputError("{}: no worker has begun here; start one with onde work",
                         request.store.string());
    const WorkState state = work_state(Store(request.store, request.lease));
    const uint32_t left = state.units - state.done;
    const double seconds = left * state.seconds_a_unit / std::max(state.workers, 1u);
    if (request.json)
        fmt::print("{}", json_line({{"units", state.units},
                                    {"done", state.done},
                                    {"left", left},
                                    {"workers", state.workers},
                                    {"workers_wanted", left},
                                    {"seconds_per_unit", state.seconds_a_unit},
                                    {"seconds_left", seconds},
                                    {"complete", state.complete}}));
    else
        fmt::print(
            "{} of {} units done, {} workers at it, {:.3g} s a unit, about {:.3g} s left{}\n",
            state.done, state.units, state.workers, state.seconds_a_unit, seconds,
            state.complete ? "; the film is complete" : "");
}

struct JobRequest {
    std::filesystem::path scene, folder;
    JobText job;
};

/// A scheduler, and what it is to be told.
struct Scheduler {
    const char *name, *help, *file;
    std::string (*text)(const JobText&);
};

constexpr Scheduler SCHEDULERS[] = {
    {"slurm", "Write job.sh for sbatch: an array of workers", "job.sh", slurm_job},
    {"openjd", "Write template.yaml of Open Job Description: parts in chunks, then their merge",
     "template.yaml", openjd_template},
    {"kubernetes", "Write job.yaml: an indexed Job of workers", "job.yaml", kubernetes_job}};

void write_job(const Scheduler& scheduler, JobRequest request) {
    std::error_code error;
    std::filesystem::create_directories(request.folder, error);
    if (error)
        throw InputError("{}: cannot be made ({}); name another folder", request.folder.string(),
                         error.message());
    request.job.scene = std::filesystem::absolute(request.scene).lexically_normal().string();
    request.job.folder = std::filesystem::absolute(request.folder).lexically_normal().string();
    check_job(request.job);
    const std::filesystem::path path = request.folder / scheduler.file;
    write_file(path, scheduler.text(request.job));
    spdlog::info("wrote {}", std::filesystem::absolute(path).string());
}

void add_scheduler(Command& farm, const Scheduler& scheduler) {
    Command command = farm.add_command(scheduler.name, scheduler.help);
    const auto request = std::make_shared<JobRequest>(); // what runs later is copied
    command.option("scene", &request->scene, "Scene, by a path that all machines know",
                   {.value = "SCENE", .required = true});
    command.option("-o,--output", &request->folder,
                   "Folder for the job file, the parts and the film; one that all machines see",
                   {.value = "DIR", .required = true});
    command.option("--spp", &request->job.samples, "Samples per pixel",
                   {.value = "N", .required = true, .least = 1, .most = 1 << 24});
    command.option("--workers", &request->job.workers, "How many at once",
                   {.value = "N", .show_default = true, .least = 1, .most = 100000});
    command.option("--with", &request->job.options,
                   "Further options of onde render, in quotes: \"--size 1920x1080 --seed 3\"",
                   {.value = "OPTIONS"});
    command.option("--image", &request->job.image, "Container with onde, for kubernetes",
                   {.value = "NAME", .show_default = true});
    command.on_run([request, &scheduler] { write_job(scheduler, *request); });
}

} // namespace

void add_farm_command(Command& root) {
    Command farm =
        root.add_command("farm", "Job files for schedulers, and how far workers are (onde work)");
    farm.require_command();
    for (const Scheduler& scheduler : SCHEDULERS) add_scheduler(farm, scheduler);
    Command command = farm.add_command("status", "How far the work in a store is");
    const auto request = std::make_shared<StatusRequest>();
    command.option("store", &request->store, "The folder", {.value = "STORE", .required = true});
    command.flag("--json", request->json, "Print it as one line of JSON");
    command.option("--lease", &request->lease, "As the workers have it",
                   {.value = "SECONDS", .show_default = true, .least = 5, .most = 1e6});
    command.on_run([request] { run_status(*request); });
}

} // namespace onde::app
