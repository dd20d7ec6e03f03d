// The chapter's pictures against its recursion in double precision, which shares no code with them.
#include "render/picture.h"
#include "scene/phong.h"
#include "support/chapter/check_picture.h"
#include "support/folders.h"

#include <iostream>

namespace onde::test {
namespace {

constexpr double TOLERANCE = 1e-4;

std::filesystem::path scene_folder() {
    return std::filesystem::path(in_project("scenes"));
}

std::vector<std::filesystem::path> chapter_scenes() {
    std::vector<std::filesystem::path> scenes;
    for (const auto& entry : std::filesystem::directory_iterator(scene_folder() / "chapter"))
        if (entry.path().extension() == ".toml") scenes.push_back(entry.path());
    std::ranges::sort(scenes);
    return scenes;
}

/// What follows for the first material that light comes through, stated so that it can be changed.
Phong& first_glass(Scene& scene) {
    uint32_t glass = 0;
    while (!(phong_of(scene, glass).transmission > 0)) glass++;
    return scene.chapter.phong[glass] = phong_of(scene, glass);
}

void compare(const std::string& name, const Scene& scene, glm::uvec2 size, uint32_t samples,
             uint32_t depth) {
    RenderOptions options = small_options(size.x, size.y, samples);
    options.integrator = IntegratorKind::whitted;
    options.depth = depth;
    const Picture picture = render_scene(scene, options);
    const auto verdict = chapter::check_picture(picture.image, scene, samples, depth, TOLERANCE);
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

TEST_CASE("scenes with every light and shape equal the recursion, sample by sample") {
    for (const char* name : {"lights", "shapes", "spheres", "cornell", "instances"})
        compare(name, load_scene(scene_folder() / fmt::format("{}.toml", name)), {120, 80}, 4, 6);
}

TEST_CASE("every setting of the chapter's recursion equals it") {
    Scene scene = load_scene(scene_folder() / "chapter/five-objects.toml");
    Phong& glass = first_glass(scene);
    const auto check = [&](const char* name) { compare(name, scene, {128, 128}, 2, 8); };
    WhittedSettings& whitted = scene.chapter.whitted;
    whitted.saturate = false;
    check("plain sums");
    whitted.reflectivity = Reflectivity::source;
    check("factors at the source");
    whitted.fresnel = true;
    check("Fresnel and factors at the source");
    whitted.reflectivity = Reflectivity::surface;
    check("Fresnel");
    whitted.distance_falloff = whitted.saturate = true; // else contacts shine without bound
    check("divided by the squared distance");
    whitted.distance_falloff = whitted.saturate = false;
    whitted.epsilon = 0.2f;
    check("stopped by epsilon");
    whitted.epsilon = 0;
    glass.abbe = 20;
    check("dispersion");
    whitted.wavelengths = 16;
    check("dispersion into 16 wavelengths");
}

} // namespace onde::test
