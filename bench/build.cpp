// How fast trees are built, how good and how large they are, and how much memory that takes: Onde's
// builders beside Embree's, in turn, again and again. Medians are printed.
#include "build_report.h"
#include "front.h"

#include "core/log.h"
#include "core/output.h"

namespace onde::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    uint32_t repetitions = 5;
    std::string json;
};

std::vector<Builder> builders_for(const Model& model) {
    std::vector<Builder> builders;
    for (Builder& builder : all_builders())
        if (model.triangles.size() <= builder.most_triangles)
            builders.push_back(std::move(builder));
        else
            spdlog::info("{}: {} is left out, more than {} triangles", model.name, builder.name,
                         builder.most_triangles);
    return builders;
}

BuildReport measure(const Model& model, uint32_t repetitions) {
    const std::vector<Builder> builders = builders_for(model);
    BuildReport report{model.name, model.triangles.size()};
    for (const Builder& builder : builders) { // starts the threads as well
        spdlog::info("{}: {}, memory", model.name, builder.name);
        report.results.push_back({builder.name, builder.build(model, Measure::memory)});
    }
    for (uint32_t repetition = 1; repetition <= repetitions; ++repetition) {
        spdlog::info("{}: building, {} of {}", model.name, repetition, repetitions);
        for (size_t i = 0; i < builders.size(); ++i)
            report.results[i].seconds.push_back(builders[i].build(model, Measure::speed).seconds);
    }
    return report;
}

void run(const Options& options) {
    if (!options.json.empty()) check_writable(options.json);
    std::vector<BuildReport> reports;
    for (const Model& model : load_models(options.scenes)) {
        reports.push_back(measure(model, options.repetitions));
        print_report(reports.back());
    }
    if (!options.json.empty()) write_json(json_of(reports), options.json);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    onde::CommandLine line("build", "Build rates, costs and sizes of Onde's trees beside Embree's");
    onde::Command root = line.root();
    root.option("scenes", &options.scenes, "scene or mesh files; without any, a terrain");
    onde::bench::add_repetitions(root, options.repetitions);
    onde::bench::add_json(root, options.json);
    return onde::bench::run_main(line, argc, argv, [&] { onde::bench::run(options); });
}
