#include "app/thumbnail_command.h"

#include "app/interrupt.h"
#include "app/progress_line.h"
#include "app/render_request.h"

#include "core/error.h"
#include "core/log.h"
#include "core/output.h"
#include "core/text.h"
#include "image/tone.h"
#include "scene/load.h"

#include <algorithm>
#include <cctype>
#include <memory>
#include <set>

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

void open_folder(const fs::path& folder) {
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw InputError("{}: this folder can't be made: {}", folder.string(), problem.message());
}

/// Returns false when it was interrupted, and then writes nothing.
bool make_picture(Machine& machine, const RenderRequest& request, const fs::path& path,
                  const StopOnInterrupt& interrupt) {
    check_writable(path);
    Session session = open_session(machine, load_requested_scene(request), request);
    ProgressLine line(request.quiet);
    const RenderOutcome outcome = session.render([&](const Progress& progress) {
        line.show(progress);
        return !interrupt.requested();
    });
    line.finish();
    if (outcome.interrupted) return false;
    const Scene& scene = session.scene();
    write_png(path, straight_alpha(session.picture()),
              display_of(scene.settings, session.options().integrator),
              {{"onde:scene_hash", scene_hash(scene)}, {"Software", "Onde " ONDE_VERSION}});
    return true;
}

/// What is told at the end: each file that has no picture, and why.
std::string list_of(const std::vector<Failure>& failures, size_t files) {
    std::string list = fmt::format("{} of {} files could not be pictured:", failures.size(), files);
    for (const Failure& failure : failures) {
        const std::string name = failure.file.string();
        const bool named = failure.sentence.starts_with(printable(name));
        list += "\n  " + (named ? "" : printable(name) + ": ") + failure.sentence;
    }
    return list;
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
    const StopOnInterrupt interrupt;
    std::vector<Failure> failures;
    bool complete = true;
    for (size_t i = 0; i < paths.size() && complete; ++i) {
        one.scene = request.files[i];
        spdlog::info("{} of {}: {} to {}", i + 1, paths.size(), printable(one.scene.string()),
                     printable(paths[i].string()));
        try {
            complete = make_picture(machine, one, paths[i], interrupt);
        } catch (const std::bad_alloc&) {
            failures.push_back({one.scene, "out of memory"});
        } catch (const std::exception& error) {
            failures.push_back({one.scene, error.what()});
        }
    }
    if (failures.empty()) return !complete;
    const std::string list = list_of(failures, paths.size());
    if (complete) throw InputError(list);
    spdlog::warn("{}", list);
    return true;
}

} // namespace

void add_thumbnail_command(Command& root, bool& interrupted) {
    const auto request = std::make_shared<ThumbnailRequest>(); // what runs later is copied
    Command command =
        root.add_command("thumbnail", "Render a small square picture of each of many files");
    command.option("files", &request->files, "Scenes: .gltf, .glb, .obj, .ply, .stl or .toml",
                   {.value = "FILE", .required = true});
    command.option("-o,--output", &request->folder, "Folder for the pictures, FILE.png each",
                   {.value = "DIR", .show_default = true});
    command.option("--size", &request->size, "Pixels of either side",
                   {.value = "N", .show_default = true, .least = 1, .most = 16384});
    command.option("--spp", &request->render.choices.samples,
                   "Samples per pixel (each scene's, else 64)", {.value = "N"});
    declare_load(command, request->render.load);
    declare_machine(command, request->render.machine);
    command.choice("--background", request->render.choices.background,
                   "What is behind the models; transparent gives the pictures an alpha channel "
                   "(environment)");
    command.flag("--quiet", request->render.quiet, "Print warnings and errors only");
    command.on_run([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
