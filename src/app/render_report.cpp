#include "app/render_report.h"

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

void print_rays(std::FILE* to, const RenderOptions& options, const RenderOutcome& outcome,
                const RayCounts& rays) {
    const double seconds = std::max(outcome.seconds, 1e-9);
    const Rectangle all{0, 0, options.width, options.height};
    const double paths = double(options.rectangle.value_or(all).pixels()) * outcome.samples;
    fmt::print(to,
               "rays      {:.1f} M closest-hit, {:.1f} M shadow; {:.2f} Mrays/s, {:.2f} per path\n",
               mega(double(sum(rays.extension))), mega(double(sum(rays.shadow))),
               mega(double(rays.total())) / seconds, double(rays.total()) / paths);
}

/// By kernel, for this picture.
std::map<std::string, gpu::KernelTime> kernel_times(const DeviceGroup& devices,
                                                    const RenderReport& r) {
    std::map<std::string, gpu::KernelTime> times = devices.kernel_times();
    for (const auto& [name, before] : r.kernels_before) {
        times[name].launches -= before.launches;
        times[name].seconds -= before.seconds;
    }
    return times;
}

std::vector<std::string> texts(const std::vector<std::filesystem::path>& paths) {
    return {paths.begin(), paths.end()};
}

double mebi(const std::vector<gpu::BufferSize>& buffers) {
    return double(gpu::total_bytes(buffers)) / 1048576;
}

} // namespace

void print_report(const DeviceGroup& devices, const RenderReport& r, std::FILE* to) {
    Session& session = devices.session();
    const gpu::DeviceFacts& device = session.device().facts();
    const RenderOptions& options = session.options();
    const Bvh& bvh = session.packed().bvh;
    const MemoryPlan plan = session.memory_plan();
    fmt::print(to, "device    {} ({}, driver {})\n", device.name, device.platform,
               device.driver_version);
    fmt::print(to, "engine    {}: {}\n", engine_name(options), gpu::describe(options.settings));
    fmt::print(to, "scene     {} triangles, {} spheres, {} instances; loaded in {:.3f} s\n",
               bvh.statistics.triangles, bvh.statistics.spheres, bvh.statistics.instances,
               r.load_seconds);
    fmt::print(to,
               "bvh       {}: {} nodes, {} leaf blocks, SAH cost {:.1f}; built in {:.3f} s "
               "({:.2f} Mtriangles/s)\n",
               word_of(bvh.layout), bvh.statistics.nodes, bvh.statistics.blocks,
               bvh.statistics.sah_cost, bvh.statistics.build_seconds,
               mega(bvh.statistics.triangles / std::max(bvh.statistics.build_seconds, 1e-9)));
    fmt::print(to, "kernels   {} in {:.3f} s\n",
               r.kernels.from_cache ? "loaded from the cache" : "compiled", r.kernels.seconds);
    fmt::print(to,
               "memory    scene {:.1f} MiB (textures {:.1f} MiB), paths in flight {:.1f} MiB, "
               "film {:.1f} MiB\n",
               mebi(plan.scene), double(session.packed().texture_bytes()) / (1 << 20),
               mebi(plan.paths), mebi(plan.film));
    fmt::print(to, "render    {:.4g} samples per pixel in {:.3f} s\n", r.outcome.samples,
               r.outcome.seconds);
    print_rays(to, options, r.outcome, devices.ray_counts());
    for (const DeviceShare& share : devices.shares())
        fmt::print(to, "share     {:4.1f} % of the samples, {} units, by {}{}\n", 100 * share.share,
                   share.units, share.device, share.is_lost ? " (failed)" : "");
    for (const auto& [name, time] : kernel_times(devices, r))
        fmt::print(to, "kernel    {:<12} {:8.3f} s in {} launches\n", name, time.seconds,
                   time.launches);
    if (!r.denoiser.empty())
        fmt::print(to, "denoise   by {} in {:.3f} s\n", r.denoiser, r.denoise_seconds);
    fmt::print(to, "total     {:.3f} s\n", r.total_seconds);
}

Json report_json(const DeviceGroup& devices, const RenderReport& r) {
    Session& session = devices.session();
    const gpu::DeviceFacts& device = session.device().facts();
    const RenderOptions& options = session.options();
    const Bvh& bvh = session.packed().bvh;
    const MemoryPlan plan = session.memory_plan();
    const RayCounts rays = devices.ray_counts();
    Json json = {
        {"scene", r.scene},
        {"scene_hash", r.scene_hash},
        {"outputs", texts(r.outputs)},
        {"version", ONDE_VERSION},
        {"device", device.name},
        {"platform", device.platform},
        {"driver", device.driver_version},
        {"engine", engine_name(options)},
        {"settings", gpu::describe(options.settings)},
        {"width", options.width},
        {"height", options.height},
        {"depth", options.depth},
        {"seed", options.seed},
        {"samples", r.outcome.samples},
        {"interrupted", r.outcome.interrupted},
        {"triangles", bvh.statistics.triangles},
        {"spheres", bvh.statistics.spheres},
        {"instances", bvh.statistics.instances},
        {"layout", word_of(bvh.layout)},
        {"load_seconds", r.load_seconds},
        {"bvh_seconds", bvh.statistics.build_seconds},
        {"pack_seconds", session.pack_seconds()},
        {"kernel_build_seconds", r.kernels.seconds},
        {"kernels_from_cache", r.kernels.from_cache},
        {"render_seconds", r.outcome.seconds},
        {"write_seconds", r.write_seconds},
        {"total_seconds", r.total_seconds},
        {"scene_bytes", gpu::total_bytes(plan.scene)},
        {"texture_bytes", session.packed().texture_bytes()},
        {"state_bytes", gpu::total_bytes(plan.paths)},
        {"film_bytes", gpu::total_bytes(plan.film)},
        {"closest_hit_rays", rays.extension},
        {"shadow_rays", rays.shadow},
        {"mrays_per_second", mega(double(rays.total())) / std::max(r.outcome.seconds, 1e-9)},
        {"invalid_samples", devices.find_invalid().count},
    };
    if (const auto noise = session.noise()) {
        json["noise"] = options.noise;
        json["noise_share"] = noise->share;
        json["noise_is_met"] = noise->is_met;
        json["fewest_samples"] = noise->fewest;
        json["most_samples"] = noise->most;
    }
    if (options.clamp > 0) json["clamped_share"] = session.clamped_share();
    if (r.at) json["at"] = *r.at;
    if (!r.denoiser.empty()) {
        json["denoiser"] = r.denoiser;
        json["denoise_seconds"] = r.denoise_seconds;
    }
    for (const DeviceShare& share : devices.shares())
        json["shares"].push_back({{"device", share.device},
                                  {"share", share.share},
                                  {"units", share.units},
                                  {"failed", share.is_lost}});
    for (const auto& [name, time] : kernel_times(devices, r))
        json["kernels"][name] = {{"seconds", time.seconds}, {"launches", time.launches}};
    return json;
}

} // namespace onde::app
