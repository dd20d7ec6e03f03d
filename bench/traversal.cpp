// How fast Onde traverses its trees, beside every way of asking Embree, in the same process:
// recorded rays, the answers compared first, then every contender in turn, again and again. Medians
// are printed.
#include "embree_scene.h"
#include "front.h"
#include "traversal_report.h"

#include "core/log.h"
#include "core/output.h"

#include <algorithm>
#include <map>
#include <optional>
#include <thread>

namespace onde::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    uint32_t side = 512;
    RaceOptions race;
    BvhBuilder builder = BvhBuilder::high;
    std::vector<std::string> sets;
    std::string device, json, kernels, against;
};

/// The sets of one model; one in which no ray starts is left out.
std::vector<SetReport> measure(const Model& model, gpu::Programs& programs, gpu::Programs* others,
                               const Options& options) {
    spdlog::info("{}: building trees around {} triangles", model.name, model.triangles.size());
    OndeTracers onde(programs, others, model.geometry(), options.builder);
    const EmbreeScene embree(model, RTC_BUILD_QUALITY_HIGH);
    spdlog::info("{}: recording rays", model.name);
    std::vector<SetReport> reports;
    for (const RaySet& set : record_rays(model, embree, options.side)) {
        if (!options.sets.empty() && !std::ranges::count(options.sets, set.name)) continue;
        spdlog::info("{}, {}: {} rays{}", model.name, set.name, set.rays.size(),
                     set.rays.empty() ? ", left out" : "");
        if (set.rays.empty()) continue;
        reports.push_back({model.name, set.name, model.triangles.size(), set.rays.size(),
                           race(set, programs.device(), embree, onde, options.race)});
        print_report(reports.back());
    }
    return reports;
}

void run(const Options& options) {
    if (!options.json.empty()) check_writable(options.json);
    gpu::KernelSources sources = gpu::KernelSources::from(options.kernels);
    gpu::KernelSources other_sources = gpu::KernelSources::from(options.against);
    const gpu::Device device = gpu::open_device(options.device);
    gpu::Programs programs(device, std::move(sources));
    gpu::Programs others(device, std::move(other_sources));
    const std::vector<Model> models = load_models(options.scenes);
    fmt::print("{}, --bvh {}; Embree {}, quality high, {} threads\n", device.facts().name,
               options.builder == BvhBuilder::high ? "high" : "sah", RTC_VERSION_STRING,
               std::thread::hardware_concurrency());
    std::vector<SetReport> reports;
    for (const Model& model : models) {
        const auto of_model =
            measure(model, programs, options.against.empty() ? nullptr : &others, options);
        reports.insert(reports.end(), of_model.begin(), of_model.end());
    }
    print_summary(reports);
    if (!options.json.empty()) write_json(json_of(reports, device.facts().name), options.json);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("traversal", "Traversal rates of Onde beside Embree's");
    onde::Command root = line.root();
    root.option("scenes", &options.scenes, "scene or mesh files; without any, a terrain");
    root.option("--side", &options.side, "pixels along each side of the picture; 4 rays each",
                {.show_default = true, .least = 64, .most = 2048});
    root.flag("--cpu-time", options.race.cpu_time,
              "count processor time instead of wall-clock time, for busy machines");
    std::map<std::string, onde::BvhBuilder> trees;
    for (const onde::BvhBuilder builder : {onde::BvhBuilder::sah, onde::BvhBuilder::high})
        trees.emplace(onde::word_of(builder), builder);
    root.choice("--bvh", options.builder, trees,
                "Onde's tree: high, the counterpart of Embree's quality high, or what renders use");
    root.option("--sets", &options.sets, "only these ray sets",
                {.value = "WORD,...",
                 .delimiter = ',',
                 .words = {"primary", "shadow", "ao", "bounce", "bounce3"}});
    root.option("--traversals", &options.race.traversals,
                "only these traversals, beside single rays",
                {.value = "WORD,...",
                 .delimiter = ',',
                 .words = {"single", "packet", "stream", "interleaved"}});
    root.option("--against", &options.against,
                "race the traversals of the kernels in this folder too", {.value = "DIR"});
    onde::bench::add_device(root, options.device);
    onde::bench::add_kernels(root, options.kernels);
    onde::bench::add_repetitions(root, options.race.repetitions);
    onde::bench::add_json(root, options.json);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
