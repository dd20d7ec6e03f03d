// The numbers of a render, for people (--stats) and for scripts (--json).
#pragma once

#include "gpu/device.h"
#include "gpu/profiler.h"
#include "render/integrator.h"
#include "render/render_loop.h"

#include <map>
#include <string>

namespace onde::app {

struct RenderReport {
    std::string scene, scene_hash;
    RenderOptions options;
    gpu::DeviceFacts device;
    BvhLayout layout = BvhLayout::wide;
    BvhStatistics bvh;
    gpu::BuildReport kernels;
    double load_seconds = 0, pack_seconds = 0, write_seconds = 0, total_seconds = 0;
    uint64_t scene_bytes = 0, state_bytes = 0, film_bytes = 0;
    RenderOutcome outcome;
    RayCounts rays;
    Film::Invalid invalid;
    std::map<std::string, gpu::KernelTime> kernel_times; ///< empty unless profiled
};

/// Several lines to standard output.
void print_report(const RenderReport& report);

/// The report as a JSON object, written atomically.
void write_report(const RenderReport& report, const std::filesystem::path& path);

} // namespace onde::app
