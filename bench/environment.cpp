// What MIS compensation of the environment's map saves (Karlik et al. 2019): the variance of
// pictures whose samples of the map are for what is brighter than a share of the mean, over that of
// samples of all of it; and that their means agree.
#include "figures.h"
#include "front.h"
#include "variance.h"

#include "scene/load.h"

#include <cmath>
#include <filesystem>

namespace onde::bench {
namespace {

namespace fs = std::filesystem;

struct Options : VarianceOptions {
    std::vector<fs::path> scenes, maps;
};

constexpr double SHARES[] = {0.25, 0.5, 0.75, 1.0};

struct NamedMap {
    std::string name;
    Environment environment;
};

template <class Radiance>
NamedMap painted(const char* name, const Radiance& radiance) {
    Image map(512, 256, 3);
    for (uint32_t y = 0; y < map.height; y++)
        for (uint32_t x = 0; x < map.width; x++) {
            const glm::vec3 color = radiance(x, y);
            for (uint32_t k = 0; k < 3; k++) map.pixel(x, y)[k] = color[glm::length_t(k)];
        }
    Environment environment;
    environment.radiance = glm::vec3(1.0f);
    environment.map = std::move(map);
    return {name, std::move(environment)};
}

/// Three texels of a sun in a blue sky over dark ground; and a smooth sky, as of an overcast day.
std::vector<NamedMap> own_maps() {
    const auto sky = [](uint32_t y) { return y < 128 ? 0.3f + 0.7f * float(y) / 128.0f : 0.1f; };
    return {painted("a small sun",
                    [&](uint32_t x, uint32_t y) {
                        const bool sun = y == 80 && x >= 300 && x < 303;
                        return sun ? glm::vec3(20000, 18000, 15000)
                                   : glm::vec3(0.4f, 0.6f, 1.0f) * sky(y);
                    }),
            painted("a gradient", [](uint32_t, uint32_t y) {
                return glm::vec3(1.0f + 2.0f * std::cos(float(y) / 256.0f * 1.5707963f));
            })};
}

std::vector<NamedMap> all_maps(const Options& options) {
    std::vector<NamedMap> maps = own_maps();
    for (const fs::path& path : options.maps)
        maps.push_back({path.stem().string(), load_environment(path, glm::vec3(1.0f), 0)});
    return maps;
}

void run(const Options& options) {
    Machine machine(options.device, gpu::KernelSources::from(options.kernels));
    fmt::print("{}x{}, {} samples, {} seeds, on {}, commit {}\n\n", options.width, options.height,
               options.samples, options.seeds, machine.device.facts().name, source_commit());
    fmt::print("| scene | map | variance without |");
    for (const double share : SHARES) fmt::print(" {:g} of the mean |", share);
    fmt::print(" means agree to, % |\n|---|---|---|---|---|---|---|---|\n");
    for (const fs::path& path : options.scenes)
        for (const NamedMap& map : all_maps(options)) {
            LoadOptions load;
            load.environment = map.environment;
            const Scene scene = load_scene(path, load);
            const auto measure = [&](double share) {
                Session session =
                    variance_session(machine, scene, options, {.compensation = share});
                return variance_over_seeds(session, options.seeds);
            };
            const Variance plain = measure(0);
            fmt::print("| {} | {} | {:.3g} |", path.stem().string(), map.name, plain.trimmed);
            double apart = 0;
            for (const double share : SHARES) {
                const Variance v = measure(share);
                fmt::print(" {:.3f} |", v.trimmed / plain.trimmed);
                apart = std::max(apart, std::abs(v.mean / plain.mean - 1));
            }
            fmt::print(" {:.2g} |\n", 100 * apart);
            std::fflush(stdout);
        }
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("environment", "What MIS compensation of environment maps saves");
    onde::Command root = line.root();
    root.option("scenes", &options.scenes, "Scene files", {.value = "SCENE", .required = true});
    root.option("--map", &options.maps, "Maps beside the two painted ones", {.value = "FILE"});
    onde::bench::add_variance(root, options);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
