#include "app/thumbnail_command.h"

#include "app/picture.h"

#include "core/error.h"
#include "core/log.h"
#include "core/output.h"
#include "core/text.h"
#include "gpu/buffer.h"
#include "image/tone.h"
#include "scene/load.h"
#include "upload/common_features.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>
#include <sstream>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

struct ThumbnailRequest {
    std::vector<fs::path> files;
    fs::path folder = "thumbnails";
    uint32_t size = 512;  ///< pixels of either side
    RenderRequest render; ///< all but scene, size and outputs
};

struct Failure {
    fs::path file;
    std::string sentence;
};

std::string shown_name(const fs::path& file) {
    return file.empty() ? "''" : printable(file.string());
}

/// A picture's name for each file: its stem, with a number from 2 on where another file has that
/// already. Names that differ by case alone clash, as some file systems do not tell them apart.
std::vector<fs::path> picture_paths(const std::vector<fs::path>& files, const fs::path& folder) {
    std::set<std::string> taken;
    std::vector<fs::path> paths;
    for (const fs::path& file : files) {
        const std::string stem = file.stem().string();
        std::string name = stem;
        const auto folded = [&] {
            std::string lower = name;
            std::ranges::transform(lower, lower.begin(),
                                   [](unsigned char c) { return char(std::tolower(c)); });
            return lower;
        };
        for (int number = 2; !taken.insert(folded()).second; ++number)
            name = fmt::format("{}-{}", stem, number);
        paths.push_back(folder / (name + ".png"));
    }
    return paths;
}

/// Throws InputError unless pictures can be written to the folder, which is made where it is new.
void open_folder(const fs::path& folder) {
    if (folder.empty() || folder == STANDARD_OUTPUT)
        throw InputError("-o '{}': is no folder; thumbnail writes a file for each scene, so name "
                         "a folder for them",
                         folder.string());
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw InputError("{}: this folder can't be made ({}); name another with -o",
                         folder.string(), problem.message());
    check_folder_writable(folder);
}

/// What the pictures of a batch have in common.
struct Workshop {
    Machine& machine;
    const RenderRequest& request; ///< all but the scene
    LoadOptions load;
    /// Of several models: kernels that can do what any of them may ask are compiled once for all.
    std::optional<SceneFeatures> features;
    StopOnInterrupt interrupt{};
};

SessionExtras extras_of(const fs::path& file, const std::optional<SceneFeatures>& features) {
    SessionExtras extras{.features = features};
    extras.on_note = [name = printable(file.string())](const std::string& note) {
        spdlog::info("{}: {}", name, note);
    };
    return extras;
}

/// Returns false when it was interrupted, and then writes nothing.
bool make_picture(const Workshop& workshop, const fs::path& file, const fs::path& path) {
    check_writable(path);
    Scene scene = load_scene(file, workshop.load);
    check_outputs_not_read({path}, workshop.request, scene);
    Session session = open_session(workshop.machine, std::move(scene), workshop.request,
                                   extras_of(file, workshop.features));
    if (const gpu::BuildReport& kernels = session.prepare(); !kernels.from_cache)
        tell_kernels(session, kernels);
    const RenderOutcome outcome =
        render_until_done(session, {}, workshop.interrupt, workshop.request.quiet);
    if (outcome.interrupted) return false;
    Outputs outputs;
    const Image picture = shown_picture(session, outputs).picture;
    write_png(path, straight_alpha(picture), requested_display(session, workshop.request),
              picture_metadata(session, scene_hash(session.scene()), outcome));
    outputs.check();
    return true;
}

/// What is told at the end: each file that has no picture, and why.
std::string list_of(const std::vector<Failure>& failures, size_t files) {
    std::string list = fmt::format("{} of {} files could not be pictured:", failures.size(), files);
    for (const Failure& failure : failures) {
        const std::string name = shown_name(failure.file);
        const bool named = failure.sentence.starts_with(name);
        list += "\n  " + (named ? "" : name + ": ") + failure.sentence;
    }
    return list;
}

/// The same where it is not what ends the program.
void warn_of(const std::vector<Failure>& failures, size_t files) {
    if (failures.empty()) return;
    std::istringstream list(list_of(failures, files));
    for (std::string line; std::getline(list, line);) spdlog::warn("{}", line);
}

/// What becomes of the files, one after the other.
struct Batch {
    std::vector<Failure> failures{};
    size_t pictures = 0;
    bool interrupted = false;
};

/// What is wrong with a file costs its picture. Throws DeviceError where the device fails, which is
/// no file's fault.
void try_picture(const Workshop& workshop, const fs::path& file, const fs::path& path,
                 Batch& batch) {
    const auto fail = [&](const char* sentence) { batch.failures.push_back({file, sentence}); };
    try {
        batch.interrupted = !make_picture(workshop, file, path);
        batch.pictures += !batch.interrupted;
    } catch (const std::bad_alloc&) {
        fail("out of memory");
    } catch (const gpu::OutOfMemory& error) {
        fail(error.what());
    } catch (const DeviceError& error) {
        throw DeviceError("{}: {} ({} of the pictures before it were made)",
                          printable(file.string()), error.what(), batch.pictures);
    } catch (const std::exception& error) {
        fail(error.what());
    }
}

void make_pictures(const Workshop& workshop, const std::vector<fs::path>& files,
                   const std::vector<fs::path>& paths, Batch& batch) {
    for (size_t i = 0; i < files.size() && !batch.interrupted; ++i) {
        spdlog::info("{} of {}: {} to {}", i + 1, files.size(), shown_name(files[i]),
                     printable(paths[i].string()));
        try_picture(workshop, files[i], paths[i], batch);
    }
}

/// Returns whether it was interrupted.
bool run(const ThumbnailRequest& request) {
    set_up_logging(request.render.quiet);
    RenderRequest one = request.render;
    one.size = fmt::format("{0}x{0}", request.size);
    check_request(one);
    open_folder(request.folder);
    const std::vector<fs::path> paths = picture_paths(request.files, request.folder);
    Machine machine = open_machine(one.machine);
    Workshop workshop{machine, one, requested_load(one), {}};
    if (paths.size() > 1) workshop.features = model_features();
    Batch batch;
    try {
        make_pictures(workshop, request.files, paths, batch);
    } catch (const DeviceError&) {
        warn_of(batch.failures, paths.size());
        throw;
    }
    if (!batch.interrupted && !batch.failures.empty())
        throw InputError(list_of(batch.failures, paths.size()));
    warn_of(batch.failures, paths.size());
    if (batch.interrupted)
        spdlog::warn("interrupted with {} of {} pictures done", batch.pictures, paths.size());
    return batch.interrupted;
}

} // namespace

void add_thumbnail_command(Command& root, bool& interrupted) {
    const auto request = std::make_shared<ThumbnailRequest>(); // what runs later is copied
    Command command =
        root.add_command("thumbnail", "Render a small square picture of each of many files");
    command.option("files", &request->files, fmt::format("Scenes: {}", SCENE_FILES),
                   {.value = "FILE", .required = true});
    command.option("-o,--output", &request->folder, "Folder for the pictures, FILE.png each",
                   {.value = "DIR", .show_default = true});
    command.option("--size", &request->size, "Pixels of either side",
                   {.value = "N", .show_default = true, .least = 1, .most = 16384});
    command.option("--spp", &request->render.choices.samples,
                   "Samples per pixel (each scene's, else 64)", {.value = "N"});
    declare_load(command, request->render.load);
    declare_machine(command, request->render.machine);
    declare_light(command, request->render);
    declare_denoiser(command, request->render);
    declare_display(command, request->render);
    command.flag("--quiet", request->render.quiet, "Print warnings and errors only");
    command.on_run([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
