// What light tracing repeats: the same bits however the work is cut; and what it counts.
#include "core/error.h"
#include "render/light_picture.h"
#include "support/folders.h"

namespace onde::test {
namespace {

Scene lights_scene() {
    return load_scene(std::filesystem::path(in_project("scenes/lights.toml")));
}

/// The first value that differs, in words; empty when none does.
std::string first_difference(const Image& a, const Image& b) {
    for (size_t i = 0; i < a.pixels.size(); i++)
        if (a.pixels[i] != b.pixels[i])
            return fmt::format("value {}: {} and {}", i, a.pixels[i], b.pixels[i]);
    return {};
}

} // namespace

TEST_CASE("light tracing gives the same bits for every engine, width, wave size, chunk and run") {
    for (const char* name : {"lights.toml", "cornell.toml", "chapter/five-objects.toml"}) {
        const Scene scene = load_scene(std::filesystem::path(in_project("scenes")) / name);
        const DeviceScene placed = place_on_device(scene);
        RenderOptions options = small_options(40, 28, 8);
        const LightPicture expected = trace_light(placed, scene, options);
        CHECK(expected.counts.contributed > 0);
        const auto check = [&](uint32_t width, uint32_t wave, uint32_t chunk, uint32_t in_flight,
                               Engine engine = Engine::wavefront,
                               gpu::Launch launch = gpu::Launch::fused) {
            options.engine = engine;
            options.settings.launch = launch;
            options.settings.width = width;
            options.settings.wave_size = wave;
            options.settings.chunk = chunk;
            options.samples_in_flight = in_flight;
            INFO(name << ", engine " << int(engine) << ", launch " << int(launch) << ", width "
                      << width << ", waves of " << wave << ", chunks of " << chunk << ", "
                      << in_flight << " samples in flight");
            const LightPicture picture = trace_light(placed, scene, options);
            CHECK(first_difference(expected.image, picture.image) == "");
            CHECK(picture.counts.contributed == expected.counts.contributed);
            CHECK(picture.counts.connections == expected.counts.connections);
            CHECK(picture.counts.unblocked == expected.counts.unblocked);
            CHECK(picture.invalid.count == 0);
        };
        check(options.settings.width, 65536, 256, 16);
        check(1, 65536, 256, 16);
        check(8, 512, 64, 4);
        check(16, 256, 16, 2);
        check(8, 512, 64, 4, Engine::wavefront, gpu::Launch::staged);
        check(8, 512, 64, 4, Engine::megakernel);
    }
}

TEST_CASE("the rays that contributed are those after which the film has changed") {
    Scene scene = lights_scene();
    const DeviceScene placed = place_on_device(scene);
    RenderOptions options = small_options(1, 1, 1);
    options.depth = 3;
    // Nothing but what rays bring: the camera sees no light itself.
    scene.cameras = {camera_at({-2, 3, 4}, {-2, 0, 0.5f}, 0.5f)};
    LightIntegrator integrator({programs(), &scene, placed, scene.cameras[0], options});
    constexpr uint32_t RAYS = 400;
    uint32_t changes = 0;
    glm::vec3 before(0);
    for (uint32_t i = 0; i < RAYS; i++) {
        integrator.render_pass(i, 1, [](double) { return true; });
        const cl_float4 sum = integrator.film().sums().read(device())[0];
        const glm::vec3 after(sum.s[0], sum.s[1], sum.s[2]);
        changes += after != before;
        before = after;
        REQUIRE(sum.s[3] == float(i + 1));
    }
    const LightCounts counts = integrator.counts();
    CHECK(counts.emitted == RAYS);
    CHECK(counts.contributed == changes);
    CHECK(changes > 0);
    CHECK(changes < RAYS);
    CHECK(counts.unblocked <= counts.connections);
    CHECK(counts.connections > 0);
}

TEST_CASE("connections that a screen before the camera blocks are counted as such") {
    Scene scene = lights_scene();
    scene.cameras = {camera_at({0, 6, 11}, {0, 0.6f, 0}, 0.6f)};
    Mesh screen;
    screen.positions = {{-9, -9, 10}, {9, -9, 10}, {0, 30, 10}};
    screen.triangles = {{0, 1, 2}};
    screen.materials = {0};
    scene.meshes.push_back(screen);
    scene.instances.push_back({uint32_t(scene.meshes.size() - 1), glm::mat4(1)});
    RenderOptions options = small_options(16, 16, 4);
    options.depth = 1; // the lights themselves, all of which are behind the screen
    const LightPicture picture = trace_light(place_on_device(scene), scene, options);
    CHECK(picture.counts.connections > 0);
    CHECK(picture.counts.unblocked == 0);
    CHECK(picture.counts.contributed == 0);
    CHECK(*std::ranges::max_element(picture.image.pixels) == 0);
}

TEST_CASE("a scene in which nothing emits is refused in a sentence") {
    Scene scene = lights_scene();
    scene.point_lights.clear();
    scene.directional_lights.clear();
    for (Material& material : scene.materials) material.emission = glm::vec3(0);
    CHECK_THROWS_AS(trace_light(place_on_device(scene), scene, small_options(8, 8, 1)), InputError);
}

TEST_CASE("lights that rays can't start at are reported, never silently dark") {
    const Scene scene = lights_scene();
    const RenderOptions options = small_options(8, 8, 1);
    const auto findings_of = [&](const PackedScene& packed) {
        const DeviceScene placed(device(), packed);
        const IntegratorContext context{programs(), &scene, placed, scene.cameras[0], options};
        return LightIntegrator(context).findings();
    };
    PackedScene packed = pack_scene(scene);
    packed.features = all_features();
    const auto about_glow = [](const std::string& sentence) {
        return sentence.find("glowing") != std::string::npos;
    };
    CHECK(std::ranges::none_of(findings_of(packed), about_glow));
    for (SurfaceRecord& surface : packed.surfaces)
        if (surface.any.light != NO_INDEX) surface.any.light = LIGHT_UNLISTED;
    CHECK(std::ranges::any_of(findings_of(packed), about_glow));
}

TEST_CASE("light tracing stopped between waves has the picture of the rays so far") {
    const Scene scene = lights_scene();
    const DeviceScene placed = place_on_device(scene);
    RenderOptions options = small_options(32, 32, 8);
    options.settings.wave_size = 1024;
    LightIntegrator integrator({programs(), &scene, placed, scene.cameras[0], options});
    integrator.render_pass(0, 8, [](double share) { return share < 0.5; });
    // Half of the eight waves: those queued before the answer to stop are finished.
    CHECK(integrator.counts().emitted == 4096);
    CHECK(integrator.film().sums().read(device())[0].s[3] == 4.0f);
}

} // namespace onde::test
