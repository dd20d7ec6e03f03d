// A replayed sample is the rendered sample, bit for bit, and its tree adds up.
#include "render/picture.h"
#include "session/inspect.h"
#include "session/integrators.h"
#include "support/folders.h"

namespace onde::test {
namespace {

struct Replay {
    Scene scene = load_scene(std::filesystem::path(in_project("scenes/chapter/five-objects.toml")));
    DeviceScene placed = place_on_device(scene);
    RenderOptions options = small_options(24, 24, 1);

    IntegratorContext context() const {
        return {programs(), &scene, placed, scene.cameras[0], options, nullptr};
    }
    /// One sample of every pixel, by the engine of the options.
    Image sample(uint32_t index) const {
        const auto integrator = make_integrator(context());
        integrator->render_pass(index, 1, [](double) { return true; });
        return integrator->film().develop();
    }
};

} // namespace

TEST_CASE("the inspected ray tree returns the colour of the rendered sample") {
    Replay replay;
    replay.options.integrator = IntegratorKind::whitted;
    for (const uint32_t sample : {0u, FILM_BLOCK}) { // films begin at blocks
        const Image picture = replay.sample(sample);
        size_t deepest = 0;
        for (uint32_t y = 1; y < 24; y += 4)
            for (uint32_t x = 1; x < 24; x += 4) {
                const TreeReport tree = inspect_whitted(replay.context(), {x, y, sample});
                INFO("pixel " << x << "," << y << ", sample " << sample);
                for (uint32_t k = 0; k < 3; k++)
                    CHECK(tree.nodes[0].returned[k] == picture.pixel(x, y)[k]);
                deepest = std::max(deepest, tree.nodes.size());
            }
        CHECK(deepest >= 4);
    }
}

TEST_CASE("each node of the inspected tree returns its own colour and its children's shares") {
    Replay replay;
    replay.options.integrator = IntegratorKind::whitted;
    const TreeReport tree = inspect_whitted(replay.context(), {12, 14, 0});
    REQUIRE(tree.nodes.size() >= 3);
    for (size_t i = 0; i < tree.nodes.size(); i++)
        for (uint32_t k = 0; k < 3; k++) {
            const NodeReport& node = tree.nodes[i];
            float parts = node.emission[k] + node.ambient[k];
            for (const SourceReport& source : tree.sources[i])
                parts = parts + source.diffuse[k] + source.specular[k];
            INFO("node " << i);
            if (!tree.sources[i].empty())
                CHECK(node.own[k] == Approx(std::min(parts, 1.0f)).margin(1e-6));
            float sum = node.own[k];
            for (size_t j = i + 1; j < tree.nodes.size(); j++)
                if (tree.nodes[j].parent == i)
                    sum = std::min(sum + tree.nodes[j].factor[k] * tree.nodes[j].returned[k], 1.0f);
            CHECK(node.returned[k] == sum);
        }
}

TEST_CASE("the inspected path has the radiance of the rendered sample") {
    Replay replay;
    for (const uint32_t sample : {0u, FILM_BLOCK}) { // films begin at blocks
        const Image picture = replay.sample(sample);
        for (uint32_t y = 1; y < 24; y += 4)
            for (uint32_t x = 1; x < 24; x += 4) {
                const PathReport path = inspect_path(replay.context(), {x, y, sample});
                INFO("pixel " << x << "," << y << ", sample " << sample);
                glm::vec3 sum(0.0f);
                for (const BounceReport& b : path.bounces)
                    for (uint32_t k = 0; k < 3; k++) {
                        sum[k] += b.emitted[k];
                        if (b.light_distance > 0 && !b.blocked) sum[k] += b.light_radiance[k];
                    }
                for (uint32_t k = 0; k < 3; k++) {
                    CHECK(path.radiance[k] == picture.pixel(x, y)[k]);
                    CHECK(sum[k] == path.radiance[k]);
                }
            }
    }
}

TEST_CASE("a pixel outside the picture is refused") {
    Replay replay;
    CHECK_THROWS_WITH(inspect_path(replay.context(), {24, 0, 0}), Catch::Contains("24x24"));
}

} // namespace onde::test
