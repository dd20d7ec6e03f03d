// Any scene can be given to any integrator, but for media to that of light.
#include "render/picture.h"
#include "scene/mapping.h"
#include "upload/media.h"

namespace onde::test {
namespace {

struct Named {
    IntegratorKind kind;
    const char* name;
};

constexpr Named INTEGRATORS[] = {{IntegratorKind::path, "path"},
                                 {IntegratorKind::whitted, "whitted"},
                                 {IntegratorKind::light, "light"},
                                 {IntegratorKind::depth_buffer, "depth-buffer"},
                                 {IntegratorKind::painter, "painter"}};

/// Lit, or black for a reason that is told: without the chapter's ambient light, for example.
bool is_picture(const Image& image, const std::vector<std::string>& notes) {
    double sum = 0;
    for (const float value : image.pixels) {
        if (!std::isfinite(value) || value < 0) return false;
        sum += value;
    }
    return sum > 0 || !notes.empty();
}

} // namespace

TEST_CASE("every integrator makes a picture of every scene") {
    for (const auto& path : project_scenes()) {
        const Scene scene = load_scene(path);
        const DeviceScene placed = place_on_device(scene);
        for (const Named& integrator : INTEGRATORS) {
            INFO(path.filename().string() << " by " << integrator.name);
            if (integrator.kind == IntegratorKind::light && has_media(scene)) continue;
            RenderOptions options = small_options(48, 32, 2);
            options.integrator = integrator.kind;
            options.depth =
                std::min(scene.settings.depth.value_or(options.depth), most_depth(integrator.kind));
            const Picture picture = render_by(scene, placed, options);
            CHECK(picture.outcome.samples == 2);
            CHECK(picture.invalid.count == 0);
            CHECK(is_picture(picture.image, mapping_notes(scene, integrator.kind)));
        }
    }
}

} // namespace onde::test
