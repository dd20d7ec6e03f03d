// The chapter's pictures against its recursion in double precision, which shares no code with them.
#include "render/picture.h"
#include "support/chapter/judge.h"

#include <iostream>

namespace onde::test {
namespace {

constexpr double TOLERANCE = 1e-4;

std::vector<std::filesystem::path> chapter_scenes() {
    std::vector<std::filesystem::path> scenes;
    const auto folder = std::filesystem::path(ONDE_SOURCE_DIR) / "scenes/chapter";
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    std::ranges::sort(scenes);
    return scenes;
}

void compare(const std::string& name, const Scene& scene, glm::uvec2 size, uint32_t samples,
             uint32_t depth) {
    RenderOptions options = small_options(size.x, size.y, samples);
    options.integrator = IntegratorKind::whitted;
    options.depth = depth;
    const Picture picture = render_by(scene, place_on_device(scene), options);
    const auto verdict = chapter::judge(picture.image, scene, samples, depth, TOLERANCE);
    const std::string sentence =
        fmt::format("{}, {}x{}, {} samples: worst {:.2e} at {}; {:.4f} % on silhouettes, {} wrong",
                    name, size.x, size.y, samples, verdict.worst, verdict.worst_pixel,
                    100 * verdict.silhouette_share(), verdict.wrong);
    std::cout << sentence << std::endl;
    INFO(sentence);
    CHECK(verdict.wrong == 0);
    CHECK(verdict.silhouette_share() <= 0.002);
}

} // namespace

TEST_CASE("every chapter scene equals the recursion in each pixel that is not on a silhouette") {
    for (const auto& path : chapter_scenes()) {
        const Scene scene = load_scene(path);
        const RenderSettings& set = scene.settings;
        const RenderOptions defaults;
        compare(path.filename().string(), scene,
                {set.width.value_or(defaults.width), set.height.value_or(defaults.height)}, 1,
                set.depth.value_or(defaults.depth));
    }
}

} // namespace onde::test
