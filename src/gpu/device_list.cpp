#include "gpu/device_list.h"

#include "core/error.h"
#include "gpu/cl_error.h"

#include <algorithm>
#include <charconv>

namespace onde::gpu {
namespace {

constexpr std::string_view ALL = "all";

std::vector<DeviceChoice> all_usable(const std::vector<PlatformReport>& platforms) {
    std::vector<DeviceChoice> choices;
    size_t index = 0;
    for (const PlatformReport& platform : platforms)
        for (const DeviceFacts& facts : platform.devices) {
            if (facts.problem.empty()) choices.push_back({.index = index});
            ++index;
        }
    if (choices.empty())
        throw DeviceError("no OpenCL device can be used; there is: {}", inventory(platforms));
    return choices;
}

/// The number behind the last slash, which is cut off; 1 where there is none.
uint32_t take_parts(std::string_view& selector) {
    const size_t slash = selector.rfind('/');
    if (slash == std::string_view::npos) return 1;
    const char *begin = selector.data() + slash + 1, *end = selector.data() + selector.size();
    uint32_t parts = 0;
    const auto read = std::from_chars(begin, end, parts);
    if (read.ec != std::errc() || read.ptr != end) return 1;
    if (parts == 0)
        throw InputError("--device {}: no parts are no device; use 1 or more", selector);
    selector = selector.substr(0, slash);
    return parts;
}

DeviceChoice choose_one(const std::vector<PlatformReport>& platforms, std::string_view selector) {
    if (const auto whole = choose_device(platforms, selector)) return {.index = *whole};
    std::string_view name = selector;
    DeviceChoice choice{.parts = take_parts(name)};
    const auto index = choose_device(platforms, name);
    if (!index)
        throw DeviceError("no OpenCL device matches '{}'; choose from: {}", selector,
                          inventory(platforms));
    choice.index = *index;
    return choice;
}

std::vector<DeviceChoice> choose_listed(const std::vector<PlatformReport>& platforms,
                                        std::string_view list) {
    std::vector<DeviceChoice> choices;
    for (size_t begin = 0; begin <= list.size();) {
        const size_t end = std::min(list.find(',', begin), list.size());
        if (end == begin)
            throw InputError("--device {} has no device between two commas; name one", list);
        const DeviceChoice choice = choose_one(platforms, list.substr(begin, end - begin));
        if (std::ranges::find(choices, choice.index, &DeviceChoice::index) != choices.end())
            throw InputError("--device {} names device {} twice; name it once", list, choice.index);
        choices.push_back(choice);
        begin = end + 1;
    }
    return choices;
}

/// Parts of the device, by the numbers of their units.
std::vector<Device> split(const Device& whole, uint32_t parts, Profiling profiling) {
    DeviceFacts facts = whole.facts();
    const uint32_t units = facts.compute_units;
    if (parts > units)
        throw InputError("device {} has {} units and can't be cut into {} parts; use at most {}",
                         facts.name, units, parts, units);
    std::vector<cl_device_partition_property> counts{CL_DEVICE_PARTITION_BY_COUNTS};
    for (uint32_t part = 0; part < parts; ++part)
        counts.push_back(cl_device_partition_property(uint64_t(units) * (part + 1) / parts -
                                                      uint64_t(units) * part / parts));
    counts.insert(counts.end(), {CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0});
    std::vector<cl::Device> raw;
    checked(fmt::format("device {} can't be cut into parts; name it as a whole", facts.name),
            [&] { cl::Device(whole.raw()).createSubDevices(counts.data(), &raw); });
    facts.global_memory /= parts;
    facts.max_allocation = std::min(facts.max_allocation, facts.global_memory);
    std::vector<Device> devices;
    for (uint32_t part = 0; part < parts; ++part) {
        facts.compute_units = uint32_t(counts[part + 1]);
        devices.emplace_back(raw.at(part), facts, profiling);
    }
    return devices;
}

bool may_be_list(std::string_view selectors) {
    return selectors == ALL || selectors.find_first_of(",/") != std::string_view::npos;
}

} // namespace

std::vector<DeviceChoice> choose_devices(const std::vector<PlatformReport>& platforms,
                                         std::string_view selectors) {
    const std::string by_default = default_selector();
    if (selectors.empty()) selectors = by_default;
    if (selectors == ALL) return all_usable(platforms);
    if (const auto one = choose_device(platforms, selectors)) return {{.index = *one}};
    return choose_listed(platforms, selectors);
}

bool names_several(std::string_view selectors) {
    const std::string by_default = default_selector();
    if (selectors.empty()) selectors = by_default;
    if (!may_be_list(selectors)) return false;
    const std::vector<DeviceChoice> choices = choose_devices(list_platforms(), selectors);
    return choices.size() > 1 || choices.front().parts > 1;
}

std::vector<Device> open_devices(std::string_view selectors, Profiling profiling) {
    std::vector<Device> devices;
    const std::string by_default = default_selector();
    if (!may_be_list(selectors.empty() ? by_default : selectors)) {
        devices.push_back(open_device(selectors, profiling));
        return devices;
    }
    for (const DeviceChoice& choice : choose_devices(list_platforms(), selectors)) {
        Device whole = open_device(std::to_string(choice.index), profiling);
        if (choice.parts == 1)
            devices.push_back(std::move(whole));
        else
            std::ranges::move(split(whole, choice.parts, profiling), std::back_inserter(devices));
    }
    return devices;
}

} // namespace onde::gpu
