#include "app/gallery_command.h"

#include "app/gallery_page.h"
#include "app/inspect_report.h"
#include "app/interrupt.h"
#include "app/progress_line.h"
#include "app/render_request.h"

#include "core/error.h"
#include "core/files.h"
#include "core/log.h"
#include "render/memory_plan.h"
#include "scene/load.h"
#include "scene/mapping.h"
#include "upload/device_scene.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <fstream>
#include <memory>

namespace onde::app {
namespace {

namespace fs = std::filesystem;

struct GalleryRequest {
    std::vector<fs::path> scenes; ///< files, and folders of .toml files
    fs::path folder = "gallery";
    RenderRequest render; ///< samples, device, kernels
};

/// A scene that hangs in the gallery, and its picture once there is one.
struct Work {
    fs::path file;
    Scene scene;
    RenderOptions options;
    Image picture;
    Exhibit exhibit;
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

/// Loads it, and finds all that can be wrong with it before anything is rendered.
Work prepare(const fs::path& file, const GalleryRequest& request, const gpu::DeviceFacts& facts) {
    Work work{file, load_scene(file), {}, {}, {}};
    work.options = resolve_options(request.render, work.scene, facts);
    check_memory(plan_memory(work.options), facts);
    Exhibit& exhibit = work.exhibit;
    exhibit.name = file.stem().string();
    exhibit.picture = exhibit.name + ".png";
    exhibit.findings = work.scene.notes;
    for (const std::string& note : mapping_notes(work.scene, work.options.integrator))
        exhibit.findings.push_back(note);
    exhibit.lesson = work.scene.lesson.value_or(Lesson{});
    if (exhibit.lesson.title.empty()) exhibit.lesson.title = exhibit.name;
    try {
        check_places(exhibit.lesson, work.options.width, work.options.height);
    } catch (const InputError& error) {
        throw InputError("{}: {}", file.string(), error.what());
    }
    return work;
}

void check_names(const std::vector<Work>& works) {
    for (size_t i = 0; i < works.size(); ++i)
        for (size_t k = 0; k < i; ++k)
            if (works[i].exhibit.name == works[k].exhibit.name)
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

std::string replay(const IntegratorContext& context, glm::uvec2 pixel) {
    const PixelSample at{pixel.x, pixel.y, 0};
    const PackedScene& packed = context.scene.packed();
    const Scene& scene = *context.description;
    const std::string words = context.options.integrator == IntegratorKind::whitted
                                  ? tree_text(inspect_whitted(context, at), scene, packed)
                                  : path_text(inspect_path(context, at), scene, packed);
    return fmt::format("sample 0 of pixel {},{}\n{}", pixel.x, pixel.y, words);
}

bool can_replay(const RenderOptions& options) {
    return options.integrator == IntegratorKind::whitted ||
           options.integrator == IntegratorKind::path;
}

std::string facts_text(const RenderOptions& options, const RenderOutcome& outcome) {
    return fmt::format("{}x{}, {} samples per pixel, --integrator {}, {:.2f} s", options.width,
                       options.height, outcome.samples, integrator_name(options.integrator),
                       outcome.seconds);
}

/// Our own scenes from the repository's root, where ./run is; others as they were given.
fs::path shown_path(const fs::path& file) {
    const fs::path chapter = ONDE_CHAPTER_SCENES;
    if (file.parent_path() != chapter) return file;
    return file.lexically_relative(chapter.parent_path().parent_path());
}

/// What all works of a gallery are made with.
struct Studio {
    const gpu::Device& device;
    const gpu::KernelSources& sources;
    const gpu::ProgramCache* cache;
    const std::atomic<bool>& stop;
};

/// Renders it; false when Ctrl-C came first.
bool paint(Work& work, const Studio& studio, const fs::path& folder) {
    const DeviceScene placed(studio.device, pack_scene(work.scene));
    const IntegratorContext context{studio.device, studio.sources,
                                    studio.cache,  &work.scene,
                                    placed,        work.scene.cameras.at(work.options.camera),
                                    work.options,  nullptr};
    const auto integrator = make_integrator(context);
    ProgressLine line(false);
    const RenderOutcome outcome = render(*integrator, work.options, studio.stop,
                                         [&](const Progress& progress) { line.show(progress); });
    line.finish();
    if (outcome.interrupted) return false;
    work.picture = integrator->film().develop(studio.device);
    for (const std::string& finding : integrator->findings())
        work.exhibit.findings.push_back(finding);
    work.exhibit.facts = facts_text(work.options, outcome);
    if (work.exhibit.lesson.inspect && can_replay(work.options))
        work.exhibit.replay = replay(context, *work.exhibit.lesson.inspect);
    write_png(folder / work.exhibit.picture, work.picture,
              {work.scene.settings.exposure.value_or(0.0f), ToneMap::none},
              {{"onde:scene_hash", scene_hash(work.scene)}, {"Software", "Onde " ONDE_VERSION}});
    return true;
}

/// Measures every picture; returns how many numbers were not found.
size_t measure(std::vector<Work>& works) {
    const auto other = [&](const std::string& name) -> const Image* {
        for (const Work& work : works)
            if (work.file.filename() == name) return &work.picture;
        return nullptr;
    };
    size_t missed = 0;
    for (Work& work : works) {
        work.exhibit.checks = check_lesson(work.exhibit.lesson, work.picture, other);
        for (const LessonCheck& check : work.exhibit.checks) {
            if (check.holds) continue;
            ++missed;
            spdlog::warn("{}: {}: expected {}, measured {}", work.exhibit.name, check.where,
                         check.expected, check.measured);
        }
    }
    return missed;
}

void write_page(const fs::path& page, const std::vector<Work>& works, const std::string& device) {
    std::vector<Exhibit> exhibits;
    for (const Work& work : works) exhibits.push_back(work.exhibit);
    const std::string html = gallery_page(exhibits, device);
    replace_file(page, [&](const fs::path& temporary) {
        std::ofstream out(temporary);
        out << html;
        if (!out.flush()) throw InputError("{}: cannot be written", page.string());
    });
    spdlog::info("wrote {}", fs::absolute(page).string());
}

/// Returns whether Ctrl-C ended it.
bool run(const GalleryRequest& request) {
    set_up_logging(false);
    check_request(request.render);
    const gpu::KernelSources sources = request.render.kernels.empty()
                                           ? gpu::KernelSources::embedded()
                                           : gpu::KernelSources::folder(request.render.kernels);
    const gpu::Device device = gpu::open_device(request.render.device);
    std::vector<Work> works;
    for (const fs::path& file : scene_files(request.scenes))
        works.push_back(prepare(file, request, device.facts()));
    check_names(works);
    open_folder(request.folder);

    const gpu::ProgramCache programs;
    const StopOnInterrupt interrupt;
    const Studio studio{device, sources, request.render.no_cache ? nullptr : &programs,
                        interrupt.requested()};
    size_t done = 0;
    for (; done < works.size(); ++done) {
        Work& work = works[done];
        work.exhibit.command = fmt::format("./run render {}", shown_path(work.file).string());
        spdlog::info("{} of {}: {}", done + 1, works.size(), work.exhibit.name);
        if (!paint(work, studio, request.folder)) break;
    }
    const bool interrupted = done < works.size();
    works.erase(works.begin() + std::ptrdiff_t(done), works.end());
    const size_t missed = measure(works);
    const fs::path page = request.folder / "index.html";
    write_page(page, works, device.facts().name);
    if (missed > 0 && !interrupted)
        throw InputError(
            "{} of the numbers that the scenes state were not found in their pictures; "
            "the page marks them",
            missed);
    return interrupted;
}

} // namespace

void add_gallery_command(CLI::App& app, bool& interrupted) {
    const auto request = std::make_shared<GalleryRequest>(); // CLI11 copies its callbacks
    request->scenes = {ONDE_CHAPTER_SCENES};
    CLI::App* command = app.add_subcommand(
        "gallery",
        "Render the chapter's scenes to a page, with their formulas and measured checks");
    command->add_option("scenes", request->scenes, "Scenes, or folders of them (scenes/chapter)")
        ->type_name("SCENE");
    command
        ->add_option("-o,--output", request->folder, "Folder for index.html and pictures (gallery)")
        ->type_name("DIR");
    command->add_option("--spp", request->render.samples, "Samples per pixel (each scene's own)")
        ->type_name("N");
    command->add_option("--device", request->render.device,
                        "Device by number or part of its name (see onde devices)");
    command->add_option("--kernels", request->render.kernels, "Read kernels from this folder")
        ->type_name("DIR");
    command->add_flag("--no-cache", request->render.no_cache, "Compile kernels anew");
    command->callback([request, &interrupted] { interrupted = run(*request); });
}

} // namespace onde::app
