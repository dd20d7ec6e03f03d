#include "app/devices_command.h"

#include "app/json.h"
#include "gpu/device.h"

#include <fmt/format.h>

#include <memory>

namespace onde::app {
namespace {

using gpu::DeviceFacts;
using gpu::PlatformReport;

const char* device_type(const DeviceFacts& facts) {
    if (facts.is_gpu) return "gpu";
    return facts.is_cpu ? "cpu" : "accelerator";
}

std::string gibibytes(uint64_t bytes) {
    return fmt::format("{:.1f} GiB", double(bytes) / double(uint64_t(1) << 30));
}

void print_device(const DeviceFacts& facts, size_t index, bool is_default) {
    fmt::print("{} {}  {}  {}, {} units, {}, largest buffer {}, driver {}\n",
               is_default ? '*' : ' ', index, facts.name, device_type(facts), facts.compute_units,
               gibibytes(facts.global_memory), gibibytes(facts.max_allocation),
               facts.driver_version);
    if (!facts.problem.empty()) fmt::print("     cannot be used: {}\n", facts.problem);
}

void print_table(const std::vector<PlatformReport>& platforms) {
    if (platforms.empty()) fmt::print("{}\n", gpu::NO_PLATFORM);
    const std::optional<size_t> by_default = gpu::choose_device(platforms);
    size_t index = 0;
    for (const PlatformReport& platform : platforms) {
        fmt::print("{} ({})\n", platform.name, platform.version);
        if (!platform.problem.empty()) fmt::print("     cannot be used: {}\n", platform.problem);
        for (const DeviceFacts& facts : platform.devices) {
            print_device(facts, index, index == by_default);
            ++index;
        }
    }
    if (by_default) fmt::print("* is used unless --device names another\n");
}

Json problem_json(const std::string& problem) {
    return problem.empty() ? Json(nullptr) : Json(problem);
}

Json device_json(const DeviceFacts& facts, size_t index, bool is_default) {
    return {{"index", index},
            {"default", is_default},
            {"name", facts.name},
            {"vendor", facts.vendor},
            {"type", device_type(facts)},
            {"units", facts.compute_units},
            {"memory_bytes", facts.global_memory},
            {"largest_buffer_bytes", facts.max_allocation},
            {"driver", facts.driver_version},
            {"problem", problem_json(facts.problem)}};
}

void print_json(const std::vector<PlatformReport>& platforms) {
    const std::optional<size_t> by_default = gpu::choose_device(platforms);
    Json all = Json::array();
    size_t index = 0;
    for (const PlatformReport& platform : platforms) {
        Json devices = Json::array();
        for (const DeviceFacts& facts : platform.devices) {
            devices.push_back(device_json(facts, index, index == by_default));
            ++index;
        }
        all.push_back({{"name", platform.name},
                       {"version", platform.version},
                       {"problem", problem_json(platform.problem)},
                       {"devices", devices}});
    }
    fmt::print("{}", json_text({{"platforms", all}}));
}

} // namespace

void add_devices_command(Command& root) {
    Command devices = root.add_command("devices", "List the OpenCL devices of this machine");
    const auto as_json = std::make_shared<bool>(false);
    devices.flag("--json", *as_json, "Print JSON");
    devices.on_run([as_json] {
        const std::vector<PlatformReport> platforms = gpu::list_platforms();
        if (*as_json)
            print_json(platforms);
        else
            print_table(platforms);
    });
}

} // namespace onde::app
