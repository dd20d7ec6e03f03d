// Passes, limits and interruptions.
#include "render/picture.h"
#include "support/folders.h"

namespace onde::test {
namespace {

Scene small_scene() {
    return load_scene(std::filesystem::path(in_project("scenes/cornell.toml")));
}

} // namespace

TEST_CASE("a render stops at its samples, whatever their number") {
    const Scene scene = small_scene();
    const DeviceScene placed = place_on_device(scene);
    for (const uint32_t samples : {1u, 3u, 7u, 16u, 21u}) {
        const RenderOptions options = small_options(16, 12, samples);
        const Picture picture = render_by(scene, placed, options);
        CHECK(picture.outcome.samples == samples);
        CHECK_FALSE(picture.outcome.interrupted);
        CHECK(picture.rays.extension.at(0) == uint64_t(16) * 12 * samples);
    }
}

TEST_CASE("a time limit ends the render after a whole pass") {
    const Scene scene = small_scene();
    RenderOptions options = small_options(16, 12, 1u << 20);
    options.seconds = 0.05;
    const Picture picture = render_scene(scene, options);
    CHECK(picture.outcome.samples >= 1);
    CHECK(picture.outcome.samples < options.samples);
    CHECK(picture.outcome.samples == std::floor(picture.outcome.samples));
    CHECK(picture.rays.extension.at(0) == uint64_t(16 * 12 * picture.outcome.samples));
}

TEST_CASE("an interrupted render keeps the samples that it has") {
    const Scene scene = small_scene();
    const DeviceScene placed = place_on_device(scene);
    RenderOptions options = small_options(16, 12, 1u << 20);
    options.samples_in_flight = 1;
    const auto integrator =
        make_integrator({programs(), &scene, placed, scene.cameras[0], options});
    std::atomic<bool> stop{false};
    const RenderOutcome outcome = render(
        *integrator, options, stop, [&](const Progress& p) { stop = p.samples >= 4; }, 1e9);
    CHECK(outcome.interrupted);
    CHECK(outcome.samples >= 4);
    CHECK(outcome.samples < 1u << 20);
    const Image image = integrator->film().develop();
    CHECK(*std::ranges::max_element(image.pixels) > 0);
}

TEST_CASE("progress is reported with shares that grow to one") {
    const Scene scene = small_scene();
    const DeviceScene placed = place_on_device(scene);
    const RenderOptions options = small_options(16, 12, 20);
    const auto integrator =
        make_integrator({programs(), &scene, placed, scene.cameras[0], options});
    const std::atomic<bool> never{false};
    std::vector<Progress> reports;
    render(
        *integrator, options, never, [&](const Progress& p) { reports.push_back(p); }, 1e9);
    REQUIRE(reports.size() >= 2);
    for (size_t i = 1; i < reports.size(); i++)
        CHECK(reports[i].fraction >= reports[i - 1].fraction);
    CHECK(reports.back().fraction == 1.0);
    CHECK(reports.back().samples == 20);
    CHECK(reports.back().rays_per_second > 0);
}

TEST_CASE("options out of range are refused with a sentence") {
    const auto refuse = [&](auto change, const char* word) {
        RenderOptions options = small_options(16, 12, 1);
        change(options);
        CHECK_THROWS_WITH(check_options(options), Catch::Contains(word));
    };
    refuse([](RenderOptions& o) { o.width = 0; }, "width");
    refuse([](RenderOptions& o) { o.samples = 0; }, "samples");
    refuse([](RenderOptions& o) { o.depth = 1024; }, "depth");
    refuse([](RenderOptions& o) { o.settings.width = 4; }, "lanes");
    refuse([](RenderOptions& o) { o.settings.chunk = 24; }, "chunk");
}

} // namespace onde::test
