// How fast the depth buffer and the painter draw many small triangles: both kinds of atomics are
// compared first, then every contender in turn, again and again. Medians, spreads and the time of
// each stage are printed.
#include "front.h"

#include "chapter/raster_depth_buffer.h"
#include "chapter/raster_painter.h"
#include "core/timer.h"

#include <algorithm>
#include <cmath>
#include <random>

namespace onde::bench {
namespace {

struct Options {
    uint32_t triangles = 1'000'000, width = 1920, height = 1080, repetitions = 7;
    float side = 3;
    std::string device, kernels;
};

/// Opaque triangles of about that many pixels along a side, thrown at random into the view.
Scene random_soup(const Options& options) {
    std::mt19937 generator(1);
    const auto number = [&] { return 2.0f * float(generator() >> 8) * 0x1p-24f - 1.0f; };
    const float aspect = float(options.width) / float(options.height);
    const float side = options.side * 2.0f / float(options.height);
    Scene scene;
    Camera camera;
    camera.camera_to_world[3] = glm::vec4(0, 0, 2, 1);
    camera.orthographic_height = 2;
    scene.cameras = {camera};
    scene.materials.resize(16);
    for (size_t i = 0; i < scene.materials.size(); ++i)
        scene.materials[i].base_color = glm::vec3(0.05f) * float(i + 1);
    Mesh mesh;
    for (uint32_t i = 0; i < options.triangles; ++i) {
        const float x = aspect * number(), y = number();
        const glm::vec3 center(x, y, number());
        for (int corner = 0; corner < 3; ++corner) {
            const float dx = number(), dy = number();
            mesh.positions.push_back(center + side * glm::vec3(dx, dy, number()));
        }
        mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
        mesh.materials.push_back(i % 16);
    }
    scene.meshes.push_back(std::move(mesh));
    scene.instances.emplace_back();
    scene.chapter.whitted.background = glm::vec3(0);
    return scene;
}

struct Contender {
    std::string name;
    gpu::Profiler profiler;
    std::unique_ptr<Integrator> integrator;
    std::vector<double> seconds;
};

/// Draws one sample of every pixel.
double draw(Contender& contender, const gpu::Device& device, uint32_t sample) {
    const Timer timer;
    contender.integrator->render_pass(sample, 1, [](double) { return true; });
    device.finish();
    return timer.seconds();
}

void print(Contender& c, const Options& options, double first) {
    std::ranges::sort(c.seconds);
    const double median = c.seconds[c.seconds.size() / 2];
    fmt::print("{:<24} {:8.1f} ms, {:6.1f} M triangles/s, spread {:.0f}%; first sample {:.1f} ms\n",
               c.name, 1e3 * median, options.triangles / median * 1e-6,
               100 * (c.seconds.back() - c.seconds.front()) / median, 1e3 * first);
    for (const auto& [kernel, time] : c.profiler.totals())
        fmt::print("  {:<22} {:8.2f} ms in a launch, {} launches\n", kernel,
                   1e3 * time.seconds / double(time.launches), time.launches);
    for (const std::string& finding : c.integrator->findings()) fmt::print("  {}\n", finding);
}

void run(const Options& bench) {
    const gpu::Device device = gpu::open_device(bench.device, gpu::Profiling::on);
    gpu::Programs programs(device, gpu::KernelSources::from(bench.kernels));
    const Scene scene = random_soup(bench);
    const DeviceScene placed(device, pack_scene(scene));
    RenderOptions options;
    options.width = bench.width;
    options.height = bench.height;
    options.settings = gpu::default_settings(device.facts());
    fmt::print("{} triangles of {} pixels along a side at {}x{} on {}\n", bench.triangles,
               bench.side, bench.width, bench.height, device.facts().name);

    std::vector<Contender> contenders(3);
    const auto context = [&](size_t i) {
        return IntegratorContext{programs,         &scene,  placed,
                                 scene.cameras[0], options, &contenders[i].profiler};
    };
    contenders[0].name = "depth buffer";
    contenders[0].integrator = make_depth_buffer(context(0), best_depth_atomics(device.facts()));
    contenders[1].name = "depth buffer, 32-bit";
    contenders[1].integrator = make_depth_buffer(context(1), DepthAtomics::narrow);
    contenders[2].name = "painter";
    contenders[2].integrator = make_painter(context(2));

    std::vector<double> first; // sorts, and warms up
    for (Contender& contender : contenders) first.push_back(draw(contender, device, 0));
    const bool same = contenders[0].integrator->film().develop().pixels ==
                      contenders[1].integrator->film().develop().pixels;
    fmt::print("64-bit and 32-bit atomics: {}\n", same ? "the same bits" : "DIFFERENT PICTURES");
    for (uint32_t i = 1; i <= bench.repetitions; ++i)
        for (Contender& contender : contenders)
            contender.seconds.push_back(draw(contender, device, i));
    for (size_t i = 0; i < contenders.size(); ++i) print(contenders[i], bench, first[i]);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("raster",
                           "Rates of the depth buffer and the painter on many small triangles");
    onde::Command root = line.root();
    root.option("--triangles", &options.triangles, "thrown at random into the view",
                {.show_default = true, .least = 1, .most = 1 << 26});
    root.option("--side", &options.side, "of a triangle, in pixels",
                {.show_default = true, .least = 0.1, .most = 1e4});
    root.option("--width", &options.width, "of the picture",
                {.show_default = true, .least = 1, .most = 16384});
    root.option("--height", &options.height, "of the picture",
                {.show_default = true, .least = 1, .most = 16384});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    onde::bench::add_repetitions(root, options.repetitions);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
