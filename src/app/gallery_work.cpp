#include "app/gallery_work.h"

#include "app/inspect_report.h"
#include "app/progress_line.h"

#include "core/error.h"
#include "core/log.h"
#include "image/image_io.h"
#include "render/memory_plan.h"
#include "scene/load.h"
#include "session/choices.h"
#include "session/integrators.h"
#include "session/session.h"

namespace onde::app {
namespace {

namespace fs = std::filesystem;

/// Our own scenes from the repository's root, where ./run is; others as they were given.
fs::path shown_path(const fs::path& file) {
    const fs::path chapter = ONDE_CHAPTER_SCENES;
    if (file.parent_path() != chapter) return file;
    return file.lexically_relative(chapter.parent_path().parent_path());
}

std::string replay(Session& session, glm::uvec2 pixel) {
    const SampleReport report = session.inspect({pixel.x, pixel.y, 0});
    return fmt::format("sample 0 of pixel {},{}\n{}", pixel.x, pixel.y,
                       sample_text(report, session.scene(), session.packed()));
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

GalleryWork load_work(const fs::path& file, const LoadOptions& load,
                      std::optional<uint32_t> samples, const gpu::DeviceFacts& facts) {
    GalleryWork work{file, load_scene(file, load), {}, {}, {}};
    RenderChoices choices;
    choices.samples = samples;
    const ResolvedOptions resolved = resolve_options(choices, work.scene, facts);
    work.options = resolved.options;
    work.scene.notes.insert(work.scene.notes.end(), resolved.notes.begin(), resolved.notes.end());
    check_memory(plan_memory(work.scene, work.options, facts), facts);
    GalleryEntry& entry = work.entry;
    entry.name = file.stem().string();
    entry.picture = entry.name + ".png";
    entry.command = fmt::format("./run render {}", shown_path(file).string());
    entry.lesson = work.scene.chapter.lesson.value_or(Lesson{});
    if (entry.lesson.title.empty()) entry.lesson.title = entry.name;
    try {
        check_places(entry.lesson, work.options.width, work.options.height);
    } catch (const InputError& error) {
        throw InputError("{}: {}", file.string(), error.what());
    }
    return work;
}

bool paint(GalleryWork& work, const GalleryStudio& studio, const fs::path& folder) {
    Session session(studio.programs, std::move(work.scene), {.render = work.options});
    ProgressLine line(false);
    const RenderOutcome outcome = session.render([&](const Progress& progress) {
        line.show(progress);
        return !studio.stop;
    });
    line.finish();
    if (outcome.interrupted) return false;
    work.picture = session.picture();
    for (const auto& sentences : {session.notes(), session.findings()})
        work.entry.findings.insert(work.entry.findings.end(), sentences.begin(), sentences.end());
    work.entry.facts = facts_text(session.options(), outcome);
    if (work.entry.lesson.inspect && can_replay(session.options()))
        work.entry.replay = replay(session, *work.entry.lesson.inspect);
    const Scene& scene = session.scene();
    write_png(folder / work.entry.picture, work.picture,
              display_of(scene.settings, session.options().integrator),
              {{"onde:scene_hash", scene_hash(scene)}, {"Software", "Onde " ONDE_VERSION}});
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
