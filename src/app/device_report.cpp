#include "app/device_report.h"

#include <fmt/format.h>

namespace onde::app {

static const char* device_type(const gpu::DeviceFacts& facts) {
    if (facts.is_gpu) return "gpu";
    return facts.is_cpu ? "cpu" : "accelerator";
}

static std::string gibibytes(uint64_t bytes) {
    return fmt::format("{:.1f} GiB", double(bytes) / double(uint64_t(1) << 30));
}

std::string device_text(const gpu::DeviceFacts& facts) {
    return fmt::format("{}  {}, {} units, {}, largest buffer {}, driver {}", facts.name,
                       device_type(facts), facts.compute_units, gibibytes(facts.global_memory),
                       gibibytes(facts.max_allocation), facts.driver_version);
}

Json problem_json(const std::string& problem) {
    return problem.empty() ? Json(nullptr) : Json(problem);
}

Json device_json(const gpu::DeviceFacts& facts) {
    return {{"name", facts.name},
            {"vendor", facts.vendor},
            {"type", device_type(facts)},
            {"units", facts.compute_units},
            {"memory_bytes", facts.global_memory},
            {"largest_buffer_bytes", facts.max_allocation},
            {"driver", facts.driver_version},
            {"problem", problem_json(facts.problem)}};
}

} // namespace onde::app
