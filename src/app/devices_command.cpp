#include "app/devices_command.h"

#include "gpu/device.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

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

/// A JSON string of the text (RFC 8259, section 7). Drivers write ASCII or UTF-8.
std::string json_string(std::string_view text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            result += fmt::format("\\u{:04x}", int(c));
        else
            result += c;
    }
    return result + '"';
}

std::string problem_json(const std::string& problem) {
    return problem.empty() ? "null" : json_string(problem);
}

std::string device_json(const DeviceFacts& facts, size_t index, bool is_default) {
    return fmt::format(
        R"({{"index": {}, "default": {}, "name": {}, "vendor": {}, "type": {}, "units": {}, )"
        R"("memory_bytes": {}, "largest_buffer_bytes": {}, "driver": {}, "problem": {}}})",
        index, is_default, json_string(facts.name), json_string(facts.vendor),
        json_string(device_type(facts)), facts.compute_units, facts.global_memory,
        facts.max_allocation, json_string(facts.driver_version), problem_json(facts.problem));
}

void print_json(const std::vector<PlatformReport>& platforms) {
    const std::optional<size_t> by_default = gpu::choose_device(platforms);
    std::vector<std::string> all;
    size_t index = 0;
    for (const PlatformReport& platform : platforms) {
        std::vector<std::string> devices;
        for (const DeviceFacts& facts : platform.devices) {
            devices.push_back(device_json(facts, index, index == by_default));
            ++index;
        }
        all.push_back(
            fmt::format(R"({{"name": {}, "version": {}, "problem": {}, "devices": [{}]}})",
                        json_string(platform.name), json_string(platform.version),
                        problem_json(platform.problem), fmt::join(devices, ", ")));
    }
    fmt::print("{{\"platforms\": [{}]}}\n", fmt::join(all, ",\n "));
}

} // namespace

void add_devices_command(CLI::App& app) {
    CLI::App* devices = app.add_subcommand("devices", "List the OpenCL devices of this machine");
    const auto as_json = std::make_shared<bool>(false);
    devices->add_flag("--json", *as_json, "Print JSON");
    devices->callback([as_json] {
        const std::vector<PlatformReport> platforms = gpu::list_platforms();
        if (*as_json)
            print_json(platforms);
        else
            print_table(platforms);
    });
}

} // namespace onde::app
