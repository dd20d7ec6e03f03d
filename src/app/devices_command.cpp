#include "app/devices_command.h"

#include "app/device_report.h"
#include "core/error.h"
#include "core/log.h"
#include "session/machine.h"
#include "upload/layout_choice.h"

#include <fmt/format.h>

#include <memory>

namespace onde::app {
namespace {

using gpu::DeviceFacts;
using gpu::PlatformReport;

void print_device(const DeviceFacts& facts, size_t index, bool is_default) {
    fmt::print("{} {}  {}\n", is_default ? '*' : ' ', index, device_text(facts));
    if (!facts.problem.empty()) fmt::print("     cannot be used: {}\n", facts.problem);
}

void print_table(const std::vector<PlatformReport>& platforms) {
    if (platforms.empty()) fmt::print("{}\n", gpu::NO_PLATFORM);
    const std::optional<size_t> by_default = gpu::choose_device(platforms, gpu::default_selector());
    size_t index = 0;
    for (const PlatformReport& platform : platforms) {
        fmt::print("{} ({})\n", platform.name, platform.version);
        if (!platform.problem.empty()) fmt::print("     cannot be used: {}\n", platform.problem);
        for (const DeviceFacts& facts : platform.devices) {
            print_device(facts, index, index == by_default);
            ++index;
        }
    }
    if (by_default) fmt::print("* is used unless --device or ONDE_DEVICE names another\n");
}

Json indexed_json(const DeviceFacts& facts, size_t index, bool is_default) {
    Json device{{"index", index}, {"default", is_default}};
    device.update(device_json(facts));
    return device;
}

void print_json(const std::vector<PlatformReport>& platforms) {
    const std::optional<size_t> by_default = gpu::choose_device(platforms, gpu::default_selector());
    Json all = Json::array();
    size_t index = 0;
    for (const PlatformReport& platform : platforms) {
        Json devices = Json::array();
        for (const DeviceFacts& facts : platform.devices) {
            devices.push_back(indexed_json(facts, index, index == by_default));
            ++index;
        }
        all.push_back({{"name", platform.name},
                       {"version", platform.version},
                       {"problem", problem_json(platform.problem)},
                       {"devices", devices}});
    }
    fmt::print("{}", json_text({{"platforms", all}}));
}

Json rates_json(const DeviceFacts& facts, std::span<const LayoutRate> rates) {
    Json layouts = Json::array();
    for (const LayoutRate& rate : rates)
        layouts.push_back({{"layout", word_of(rate.layout)}, {"mrays", rate.mrays}});
    return {
        {"device", facts.name}, {"layouts", layouts}, {"chosen", word_of(fastest_layout(rates))}};
}

void print_rates(const DeviceFacts& facts, std::span<const LayoutRate> rates) {
    fmt::print("{}\n{:<12} {:>9}\n", facts.name, "layout", "Mrays/s");
    for (const LayoutRate& rate : rates)
        fmt::print("{:<12} {:9.2f}\n", word_of(rate.layout), rate.mrays);
    fmt::print("{} is what renders on this device use from now on\n",
               word_of(fastest_layout(rates)));
}

struct DevicesRequest {
    bool json = false, measure = false;
    std::string device;
};

void measure(const DevicesRequest& request) {
    set_up_logging(false);
    Machine machine(request.device);
    const gpu::Device& device = machine.device;
    const auto rates = measure_layouts(machine.programs);
    LayoutMemory().remember(device.facts(), fastest_layout(rates));
    if (request.json)
        fmt::print("{}", json_text(rates_json(device.facts(), rates)));
    else
        print_rates(device.facts(), rates);
}

} // namespace

void add_devices_command(Command& root) {
    Command devices = root.add_command("devices", "List the OpenCL devices of this machine");
    const auto request = std::make_shared<DevicesRequest>();
    devices.flag("--json", request->json, "Print JSON");
    devices.flag("--measure", request->measure,
                 "Measure which layout of the tree suits a device, and remember it");
    devices.option("--device", &request->device, "The device to measure, as for render");
    devices.on_run([request] {
        if (request->measure) return measure(*request);
        if (!request->device.empty())
            throw InputError("--device says what --measure measures; add --measure");
        const std::vector<PlatformReport> platforms = gpu::list_platforms();
        if (request->json)
            print_json(platforms);
        else
            print_table(platforms);
    });
}

} // namespace onde::app
