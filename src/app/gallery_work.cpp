#include "app/gallery_work.h"

#include "app/inspect_report.h"
#include "app/progress_line.h"
#include "app/render_request.h"

#include "core/error.h"
#include "core/log.h"
#include "render/memory_plan.h"
#include "scene/load.h"
#include "scene/mapping.h"
#include "session/integrators.h"
#include "upload/device_scene.h"

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// Our own scenes from the repository's root, where ./run is; others as they were given.
fs::path shown_path(const fs::path& file) {
    const fs::path chapter = ONDE_CHAPTER_SCENES;
    if (file.parent_path() != chapter) return file;
    return file.lexically_relative(chapter.parent_path().parent_path());
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
                       options.height, outcome.samples, word_of(options.integrator),
                       outcome.seconds);
}

} // namespace

GalleryWork load_work(const fs::path& file, std::optional<uint32_t> samples,
                      const gpu::DeviceFacts& facts) {
    GalleryWork work{file, load_scene(file), {}, {}, {}};
    RenderRequest request;
    request.samples = samples;
    work.options = resolve_options(request, work.scene, facts);
    check_memory(plan_memory(work.scene, work.options, facts), facts);
    GalleryEntry& entry = work.entry;
    entry.name = file.stem().string();
    entry.picture = entry.name + ".png";
    entry.command = fmt::format("./run render {}", shown_path(file).string());
    entry.findings = work.scene.notes;
    for (const std::string& note : mapping_notes(work.scene, work.options.integrator))
        entry.findings.push_back(note);
    entry.lesson = work.scene.lesson.value_or(Lesson{});
    if (entry.lesson.title.empty()) entry.lesson.title = entry.name;
    try {
        check_places(entry.lesson, work.options.width, work.options.height);
    } catch (const InputError& error) {
        throw InputError("{}: {}", file.string(), error.what());
    }
    return work;
}

bool paint(GalleryWork& work, const GalleryStudio& studio, const fs::path& folder) {
    const BvhOptions tree = resolve_bvh({}, studio.programs);
    const DeviceScene placed(studio.programs.device(), pack_scene(work.scene, tree));
    const IntegratorContext context{studio.programs, &work.scene, placed,
                                    work.scene.cameras.at(work.options.camera), work.options};
    const auto integrator = make_integrator(context);
    ProgressLine line(false);
    const RenderOutcome outcome = render(*integrator, work.options, studio.stop,
                                         [&](const Progress& progress) { line.show(progress); });
    line.finish();
    if (outcome.interrupted) return false;
    work.picture = integrator->film().develop();
    for (const std::string& finding : integrator->findings())
        work.entry.findings.push_back(finding);
    work.entry.facts = facts_text(work.options, outcome);
    if (work.entry.lesson.inspect && can_replay(work.options))
        work.entry.replay = replay(context, *work.entry.lesson.inspect);
    write_png(folder / work.entry.picture, work.picture,
              {work.scene.settings.exposure.value_or(0.0f), ToneMap::none},
              {{"onde:scene_hash", scene_hash(work.scene)}, {"Software", "Onde " ONDE_VERSION}});
    return true;
}

size_t measure(std::vector<GalleryWork>& works) {
    const auto other = [&](const std::string& name) -> const Image* {
        for (const GalleryWork& work : works)
            if (work.file.filename() == name) return &work.picture;
        return nullptr;
    };
    size_t missed = 0;
    for (GalleryWork& work : works) {
        work.entry.checks = check_lesson(work.entry.lesson, work.picture, other);
        for (const LessonCheck& check : work.entry.checks) {
            if (check.holds) continue;
            ++missed;
            spdlog::warn("{}: {}: expected {}, measured {}", work.entry.name, check.where,
                         check.expected, check.measured);
        }
    }
    return missed;
}

} // namespace onde::app
