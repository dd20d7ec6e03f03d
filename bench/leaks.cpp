// How many rays leak through the edges and corners of closed meshes, with the watertight option and
// without, and what the option costs: the same rays, with and without in turn.
#include "front.h"

#include "chapter/leak_trials.h"

#include <algorithm>

namespace onde::bench {
namespace {

struct Options {
    double rays = 1e7;
    uint32_t repetitions = 1;
    std::string device;
};

struct Ball {
    const char* name;
    uint32_t subdivisions;
    glm::vec3 size;
};

double median(std::vector<double> values) {
    std::ranges::sort(values);
    return values[values.size() / 2];
}

void run(const Options& options) {
    const gpu::Device device = gpu::open_device(options.device);
    gpu::Programs programs(device, gpu::KernelSources::embedded());
    const Ball balls[] = {{"round", 5, glm::vec3(1)},
                          {"long and flat", 5, {100, 1, 0.01f}},
                          {"many triangles", 8, glm::vec3(1)},
                          {"few triangles", 1, {1, 2, 3}}};
    fmt::print("{}\n{:<15} {:>10} {:>12} {:>10} {:>12} {:>8} {:>8}\n", device.facts().name, "ball",
               "triangles", "rays", "leaks", "watertight", "Mrays/s", "cost");
    LeakTrials all[2];
    for (const Ball& ball : balls) {
        std::vector<double> seconds[2];
        LeakTrials last[2];
        for (uint32_t i = 0; i < options.repetitions; ++i)
            for (const bool watertight : {false, true}) {
                last[watertight] = count_leaks(programs, ball.subdivisions, ball.size, watertight,
                                               uint64_t(options.rays / std::size(balls)));
                seconds[watertight].push_back(last[watertight].seconds);
            }
        fmt::print("{:<15} {:10} {:12} {:10} {:12} {:8.2f} {:7.0f}%\n", ball.name,
                   8u << 2 * ball.subdivisions, last[1].rays, last[0].leaks, last[1].leaks,
                   double(last[1].rays) / median(seconds[1]) * 1e-6,
                   100 * (median(seconds[1]) / median(seconds[0]) - 1));
        for (const bool watertight : {false, true}) {
            all[watertight].rays += last[watertight].rays;
            all[watertight].leaks += last[watertight].leaks;
        }
    }
    fmt::print("{} rays: {} leaks without the option, {} with it\n", all[1].rays, all[0].leaks,
               all[1].leaks);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("leaks", "Leaks through closed meshes, with and without --watertight");
    onde::Command root = line.root();
    root.option("--rays", &options.rays, "in all, for example 1e8",
                {.show_default = true, .least = 1e3, .most = 1e12});
    onde::bench::add_device(root, options.device);
    onde::bench::add_repetitions(root, options.repetitions);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
