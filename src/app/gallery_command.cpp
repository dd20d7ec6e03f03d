#include "app/gallery_command.h"

#include "app/gallery_work.h"
#include "app/interrupt.h"
#include "app/render_request.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "core/output.h"

#include <algorithm>
#include <memory>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

struct GalleryRequest {
    std::vector<fs::path> scenes; ///< files, and folders of .toml files
    fs::path folder = "gallery";
    RenderRequest render; ///< samples, device, kernels
};

std::vector<fs::path> scene_files(const std::vector<fs::path>& given) {
    std::vector<fs::path> files;
    for (const fs::path& path : given) {
        if (!fs::is_directory(path)) {
            files.push_back(path);
            continue;
        }
        const size_t before = files.size();
        for (const auto& entry : fs::directory_iterator(path))
            if (entry.path().extension() == ".toml") files.push_back(entry.path());
        if (files.size() == before)
            throw InputError("{}: there is no .toml scene in this folder", path.string());
        std::sort(files.begin() + std::ptrdiff_t(before), files.end());
    }
    return files;
}

void check_names(const std::vector<GalleryWork>& works) {
    for (size_t i = 0; i < works.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (works[i].entry.name == works[k].entry.name)
                throw InputError("{} and {} would have the same picture; rename one",
                                 works[k].file.string(), works[i].file.string());
}

/// Makes the folder; throws InputError where a page that is not ours stands in the way.
void open_folder(const fs::path& folder) {
    const fs::path page = folder / "index.html";
    std::error_code problem;
    fs::create_directories(folder, problem);
    if (problem)
        throw InputError("{}: this folder can't be made: {}", folder.string(), problem.message());
    check_writable(page);
    if (fs::exists(page) && read_file(page).find(GALLERY_MARK) == std::string::npos)
        throw InputError("{}: this page is not a gallery of Onde's and would be lost; give another "
                         "folder with -o",
                         page.string());
}

void write_page(const fs::path& page, const std::vector<GalleryWork>& works,
                const std::string& device) {
    std::vector<GalleryEntry> entries;
    for (const GalleryWork& work : works) entries.push_back(work.entry);
    write_file(page, gallery_page(entries, device));
    spdlog::info("wrote {}", fs::absolute(page).string());
}

/// Returns whether Ctrl-C ended it.
bool run(const GalleryRequest& request) {
    set_up_logging(false);
    check_request(request.render);
    Machine machine = open_machine(request.render.machine);
    std::vector<GalleryWork> works;
    for (const fs::path& file : scene_files(request.scenes))
        works.push_back(load_work(file, load_options(request.render.load),
                                  request.render.choices.samples, machine.device.facts()));
    check_names(works);
    open_folder(request.folder);

    const StopOnInterrupt interrupt;
    const GalleryStudio studio{machine.programs, interrupt.requested()};
    size_t done = 0;
    for (; done < works.size(); ++done) {
        GalleryWork& work = works[done];
        spdlog::info("{} of {}: {}", done + 1, works.size(), work.entry.name);
        if (!paint(work, studio, request.folder)) break;
    }
    const bool interrupted = done < works.size();
    works.erase(works.begin() + std::ptrdiff_t(done), works.end());
    if (works.empty()) return interrupted; // an earlier page stays as it is
    const size_t missed = measure(works);
    const fs::path page = request.folder / "index.html";
    write_page(page, works, machine.device.facts().name);
    if (missed > 0 && !interrupted)
        throw InputError(
            "{} of the numbers that the scenes state were not found in their pictures; "
            "the page marks them",
            missed);
    return interrupted;
}

} // namespace

void add_gallery_command(Command& root, bool& interrupted) {
    const auto request = std::make_shared<GalleryRequest>(); // what runs later is copied
    request->scenes = {ONDE_CHAPTER_SCENES};
    Command command = root.add_command(
        "gallery",
        "Render the chapter's scenes to a page, with their formulas and measured checks");
    command.option("scenes", &request->scenes, "Scenes, or folders of them (scenes/chapter)",
                   {.value = "SCENE"});
    command.option("-o,--output", &request->folder, "Folder for index.html and pictures (gallery)",
                   {.value = "DIR"});
    command.option("--spp", &request->render.choices.samples,
                   "Samples per pixel (each scene's own)", {.value = "N"});
    declare_load(command, request->render.load);
    declare_machine(command, request->render.machine);
    command.on_run([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
