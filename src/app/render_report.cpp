#include "app/render_report.h"

#include "app/json.h"
#include "core/files.h"
#include "upload/layout_choice.h"

#include <fmt/format.h>

#include <numeric>

namespace onde::app {
namespace {

uint64_t sum(const std::vector<uint64_t>& values) {
    return std::accumulate(values.begin(), values.end(), uint64_t(0));
}

double mega(double value) {
    return value * 1e-6;
}

std::string engine_name(const RenderOptions& options) {
    const std::string engine(word_of(options.engine));
    if (options.engine == Engine::megakernel) return engine;
    return fmt::format("{}, {}", engine, word_of(options.settings.launch));
}

void print_rays(const RenderReport& r) {
    const double seconds = std::max(r.outcome.seconds, 1e-9);
    const double paths = double(r.options.width) * r.options.height * r.outcome.samples;
    fmt::print("rays      {:.1f} M closest-hit, {:.1f} M shadow; {:.2f} Mrays/s, {:.2f} per path\n",
               mega(double(sum(r.rays.extension))), mega(double(sum(r.rays.shadow))),
               mega(double(r.rays.total())) / seconds, double(r.rays.total()) / paths);
}

void print_kernel_times(const RenderReport& r) {
    for (const auto& [name, time] : r.kernel_times)
        fmt::print("kernel    {:<12} {:8.3f} s in {} launches\n", name, time.seconds,
                   time.launches);
}

} // namespace

void print_report(const RenderReport& r) {
    fmt::print("device    {} ({}, driver {})\n", r.device.name, r.device.platform,
               r.device.driver_version);
    fmt::print("engine    {}: {}\n", engine_name(r.options), gpu::describe(r.options.settings));
    fmt::print("scene     {} triangles, {} spheres, {} instances; loaded in {:.3f} s\n",
               r.bvh.triangles, r.bvh.spheres, r.bvh.instances, r.load_seconds);
    fmt::print("bvh       {}: {} nodes, {} leaf blocks, SAH cost {:.1f}; built in {:.3f} s "
               "({:.2f} Mtriangles/s)\n",
               word_of(r.layout), r.bvh.nodes, r.bvh.blocks, r.bvh.sah_cost, r.bvh.build_seconds,
               mega(r.bvh.triangles / std::max(r.bvh.build_seconds, 1e-9)));
    fmt::print("kernels   {} in {:.3f} s\n",
               r.kernels.from_cache ? "loaded from the cache" : "compiled", r.kernels.seconds);
    fmt::print("memory    scene {:.1f} MiB, paths in flight {:.1f} MiB, film {:.1f} MiB\n",
               double(r.scene_bytes) / 1048576, double(r.state_bytes) / 1048576,
               double(r.film_bytes) / 1048576);
    fmt::print("render    {:.4g} samples per pixel in {:.3f} s\n", r.outcome.samples,
               r.outcome.seconds);
    print_rays(r);
    print_kernel_times(r);
    fmt::print("total     {:.3f} s\n", r.total_seconds);
}

void write_report(const RenderReport& r, const std::filesystem::path& path) {
    Json json = {
        {"scene", r.scene},
        {"scene_hash", r.scene_hash},
        {"version", ONDE_VERSION},
        {"device", r.device.name},
        {"platform", r.device.platform},
        {"driver", r.device.driver_version},
        {"engine", engine_name(r.options)},
        {"settings", gpu::describe(r.options.settings)},
        {"width", r.options.width},
        {"height", r.options.height},
        {"depth", r.options.depth},
        {"seed", r.options.seed},
        {"samples", r.outcome.samples},
        {"interrupted", r.outcome.interrupted},
        {"triangles", r.bvh.triangles},
        {"spheres", r.bvh.spheres},
        {"instances", r.bvh.instances},
        {"layout", word_of(r.layout)},
        {"load_seconds", r.load_seconds},
        {"bvh_seconds", r.bvh.build_seconds},
        {"pack_seconds", r.pack_seconds},
        {"kernel_build_seconds", r.kernels.seconds},
        {"kernels_from_cache", r.kernels.from_cache},
        {"render_seconds", r.outcome.seconds},
        {"write_seconds", r.write_seconds},
        {"total_seconds", r.total_seconds},
        {"scene_bytes", r.scene_bytes},
        {"state_bytes", r.state_bytes},
        {"film_bytes", r.film_bytes},
        {"closest_hit_rays", r.rays.extension},
        {"shadow_rays", r.rays.shadow},
        {"mrays_per_second", mega(double(r.rays.total())) / std::max(r.outcome.seconds, 1e-9)},
        {"invalid_samples", r.invalid.count},
    };
    for (const auto& [name, time] : r.kernel_times)
        json["kernels"][name] = {{"seconds", time.seconds}, {"launches", time.launches}};
    write_text(path, json_text(json));
}

} // namespace onde::app
