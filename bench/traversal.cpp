// How fast Onde walks and builds its trees, beside Embree in the same process: recorded rays, the
// answers compared first, then every contender in turn, again and again. Medians are printed.
#include "traversal_embree.h"
#include "traversal_onde.h"
#include "traversal_report.h"

#include "core/error.h"

#include <CLI/CLI.hpp>

#include <chrono>
#include <cmath>
#include <ctime>
#include <functional>
#include <thread>

namespace onde::bench {
namespace {

struct Options {
    std::vector<std::string> scenes;
    uint32_t repetitions = 5;
    uint32_t side = 512;
    std::string device, json, kernels;
    bool cpu_time = false;
};

/// Wall-clock seconds, or processor seconds of all threads over their number, which other work on
/// the machine disturbs less.
double now(bool cpu_time) {
    if (cpu_time)
        return double(std::clock()) / CLOCKS_PER_SEC / std::thread::hardware_concurrency();
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

const char* const REFERENCE = "embree high";

Build describe_build(const char* builder, const Model& model, double seconds, double bytes) {
    const auto count = double(model.triangles.size());
    return {builder, seconds, count / seconds * 1e-6, bytes / count};
}

Build describe_build(const Model& model, const Bvh& tree) {
    const double bytes = double(tree.nodes.size() * sizeof(BvhNode)) +
                         double(tree.blocks.size() * sizeof(TriangleBlock));
    Build build = describe_build("onde", model, tree.statistics.build_seconds, bytes);
    build.sah_cost = tree.statistics.sah_cost;
    return build;
}

size_t count_differences(const std::vector<Hit>& hits, const std::vector<Hit>& expected) {
    size_t count = 0;
    for (size_t i = 0; i < hits.size(); ++i) {
        const float a = hits[i].t, b = expected[i].t;
        count += !(std::abs(a - b) <= 1e-4f * std::abs(b));
    }
    return count;
}

size_t count_differences(const std::vector<uint32_t>& blocked,
                         const std::vector<uint32_t>& expected) {
    size_t count = 0;
    for (size_t i = 0; i < blocked.size(); ++i) count += blocked[i] != expected[i];
    return count;
}

struct Contender {
    std::string name;
    std::function<void()> run;
    std::function<size_t()> differences; ///< of the last run, to the reference's
};

/// The answers of one ray set, by contender, and how each contender finds them.
class Race {
  public:
    Race(const RaySet& set, const gpu::Device& device, OndeTracer& onde, OndeTracer& watertight,
         const EmbreeTracer& high, const EmbreeTracer& medium)
        : set_(set), device_(device), on_device_(device, set.rays), expected_hits_(set.rays.size()),
          expected_blocked_(set.rays.size()) {
        add_embree(REFERENCE, high);
        add_embree("embree medium", medium);
        const auto single = set.any_hit ? &OndeTracer::occluded : &OndeTracer::closest;
        add_onde("onde single", onde, single);
        if (!set.any_hit) add_onde("onde packet", onde, &OndeTracer::closest_packet);
        add_onde("onde watertight", watertight, single);
    }

    std::vector<Timing> run(const Options& options) {
        std::vector<Timing> timings;
        for (Contender& contender : contenders_) { // warms up as well
            contender.run();
            timings.push_back({set_.name, contender.name, set_.rays.size(), {}, 0});
            timings.back().differences = contender.differences();
        }
        for (uint32_t repetition = 0; repetition < options.repetitions; ++repetition)
            for (size_t i = 0; i < contenders_.size(); ++i) {
                const double start = now(options.cpu_time);
                contenders_[i].run();
                timings[i].seconds.push_back(now(options.cpu_time) - start);
            }
        return timings;
    }

  private:
    void add_embree(const char* name, const EmbreeTracer& tracer) {
        const bool is_reference = name == REFERENCE;
        const auto run = [this, &tracer, is_reference] {
            if (set_.any_hit)
                tracer.occluded(set_.rays, is_reference ? expected_blocked_ : blocked_);
            else
                tracer.closest(set_.rays, is_reference ? expected_hits_ : hits_);
        };
        hits_.resize(set_.rays.size());
        blocked_.resize(set_.rays.size());
        contenders_.push_back({name, run, [this, is_reference] {
                                   return is_reference ? 0 : differences(hits_, blocked_);
                               }});
    }

    void add_onde(const char* name, OndeTracer& onde,
                  void (OndeTracer::*trace)(const DeviceRays&)) {
        contenders_.push_back({name, [this, &onde, trace] { (onde.*trace)(on_device_); },
                               [this] {
                                   return differences(on_device_.hits.read(device_),
                                                      on_device_.blocked.read(device_));
                               }});
    }

    size_t differences(const std::vector<Hit>& hits, const std::vector<uint32_t>& blocked) const {
        return set_.any_hit ? count_differences(blocked, expected_blocked_)
                            : count_differences(hits, expected_hits_);
    }

    const RaySet& set_;
    const gpu::Device& device_;
    DeviceRays on_device_;
    std::vector<Hit> expected_hits_, hits_;
    std::vector<uint32_t> expected_blocked_, blocked_;
    std::vector<Contender> contenders_;
};

Report measure(const Model& model, const gpu::Device& device, const gpu::KernelSources& sources,
               const Options& options) {
    const Geometry geometry = model.geometry();
    const Placement placement;
    build_bvh({&geometry, 1}, {&placement, 1}); // starts the threads that the timed build uses
    const Bvh tree = build_bvh({&geometry, 1}, {&placement, 1});
    const EmbreeTracer high(model, RTC_BUILD_QUALITY_HIGH);
    const EmbreeTracer medium(model, RTC_BUILD_QUALITY_MEDIUM);
    OndeTracer onde(device, sources, tree);
    const Bvh tight_tree = build_bvh({&geometry, 1}, {&placement, 1}, {.watertight = true});
    OndeTracer watertight(device, sources, tight_tree);

    Report report{model.name, device.facts().name, model.triangles.size()};
    report.builds = {
        describe_build(model, tree),
        describe_build("embree medium", model, medium.build_seconds(), double(medium.bytes())),
        describe_build("embree high", model, high.build_seconds(), double(high.bytes()))};
    for (const RaySet& set : record_rays(model, high, options.side)) {
        const auto timings = Race(set, device, onde, watertight, high, medium).run(options);
        report.timings.insert(report.timings.end(), timings.begin(), timings.end());
    }
    return report;
}

void run(const Options& options) {
    const gpu::Device device = gpu::open_device(options.device);
    const gpu::KernelSources sources = options.kernels.empty()
                                           ? gpu::KernelSources::embedded()
                                           : gpu::KernelSources::folder(options.kernels);
    std::vector<Model> models;
    for (const std::string& scene : options.scenes) models.push_back(load_model(scene));
    if (models.empty()) models.push_back(terrain_model(720));

    std::vector<Report> reports;
    for (const Model& model : models) {
        reports.push_back(measure(model, device, sources, options));
        print_report(reports.back(), REFERENCE);
    }
    if (!options.json.empty()) write_json(reports, options.json);
}

} // namespace
} // namespace onde::bench

int main(int argc, char** argv) {
    onde::bench::Options options;
    CLI::App app{"Traversal and build rates of Onde beside Embree"};
    app.add_option("scenes", options.scenes, "scene files; without any, a generated terrain");
    app.add_option("--repetitions", options.repetitions, "timed runs of each contender")
        ->check(CLI::Range(1, 1000));
    app.add_option("--side", options.side, "pixels along each side; 4 rays each")
        ->check(CLI::Range(64, 2048));
    app.add_flag("--cpu-time", options.cpu_time,
                 "count processor time instead of wall-clock time, for busy machines");
    app.add_option("--device", options.device, "OpenCL device, as for onde");
    app.add_option("--json", options.json, "also write the figures to this file");
    app.add_option("--kernels", options.kernels, "read kernels from this folder");
    CLI11_PARSE(app, argc, argv);
    try {
        onde::bench::run(options);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
