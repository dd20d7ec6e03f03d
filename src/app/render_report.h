// The numbers of a render, for people (--stats) and for scripts (--json).
#pragma once

#include "app/json.h"
#include "session/device_group.h"

#include <cstdio>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace onde::app {

/// What a session does not know of a picture that it made.
struct RenderReport {
    std::string scene{}, scene_hash{};
    std::vector<std::filesystem::path> outputs{};
    std::optional<double> at{}; ///< seconds of the animation
    double load_seconds = 0, write_seconds = 0, total_seconds = 0;
    std::string denoiser{}; ///< empty: none
    double denoise_seconds = 0;
    gpu::BuildReport kernels{.from_cache = true}; ///< that were built for it
    RenderOutcome outcome{};
    std::map<std::string, gpu::KernelTime> kernels_before{}; ///< of the session's other pictures
};

/// Several lines to that stream.
void print_report(const DeviceGroup& devices, const RenderReport& report, std::FILE* to);

/// The same numbers as a JSON object.
Json report_json(const DeviceGroup& devices, const RenderReport& report);

} // namespace onde::app
