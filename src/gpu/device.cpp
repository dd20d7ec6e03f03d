#include "gpu/device.h"

#include "core/error.h"
#include "gpu/cl_error.h"
#include "gpu/pocl_environment.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <functional>

namespace onde::gpu {
namespace {

/// A platform as reported, with the devices themselves in the same order.
struct Platform {
    PlatformReport report;
    std::vector<cl::Device> devices;
};

std::string reason(const cl::Error& error) {
    return fmt::format("{}: {}", error.what(), error_name(error.err()));
}

/// Calls `ask`, which may add to what a report knows; a failure is written to `problem` instead.
void ask(std::string& problem, const std::function<void()>& question) {
    try {
        question();
    } catch (const cl::Error& error) {
        if (problem.empty()) problem = reason(error);
    }
}

void learn_host_cpu(DeviceFacts& facts) {
#if defined(__x86_64__)
    facts.avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
    facts.avx512 = __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                   __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
#else
    (void)facts;
#endif
}

/// PoCL may compile for less than the host has (POCL_KERNELLIB_NAME): its device's name then names
/// one of the processors that Debian's kernel libraries are for.
void learn_pocl_target(DeviceFacts& facts) {
    const auto aims_at = [&](const char* cpu) {
        return facts.name.find(fmt::format("-{}-", cpu)) != std::string::npos;
    };
    for (const char* older : {"sandybridge", "ivybridge", "bdver1", "penryn", "core2", "athlon64"})
        if (aims_at(older)) facts.avx2 = facts.avx512 = false;
    if (aims_at("haswell")) facts.avx512 = false;
}

/// Why a device that answers is still of no use to us, or nothing.
std::string shortcoming(const cl::Device& device) {
    if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "the driver says it is not available";
    if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "its driver has no compiler";
    if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "it is big-endian";
    const std::string version = device.getInfo<CL_DEVICE_VERSION>(); // "OpenCL 1.2 ..."
    if (version.starts_with("OpenCL 1.0") || version.starts_with("OpenCL 1.1"))
        return "it is older than OpenCL 1.2";
    return {};
}

void learn_device(const cl::Device& device, DeviceFacts& facts) {
    facts.name = device.getInfo<CL_DEVICE_NAME>();
    facts.vendor = device.getInfo<CL_DEVICE_VENDOR>();
    facts.driver_version = device.getInfo<CL_DRIVER_VERSION>();
    const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
    facts.is_gpu = type & CL_DEVICE_TYPE_GPU;
    facts.is_cpu = type & CL_DEVICE_TYPE_CPU && !facts.is_gpu;
    facts.unified_memory = device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>();
    if (facts.is_cpu) learn_host_cpu(facts);
    facts.compute_units = device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>();
    facts.global_memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    facts.cache = device.getInfo<CL_DEVICE_GLOBAL_MEM_CACHE_SIZE>();
    facts.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    facts.max_work_group_size = device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>();
    facts.correctly_rounded_divide_sqrt =
        device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
    const std::string extensions = device.getInfo<CL_DEVICE_EXTENSIONS>();
    facts.int64_atomics = extensions.find("cl_khr_int64_extended_atomics") != std::string::npos;
    facts.problem = shortcoming(device);
}

bool is_pocl(const PlatformReport& platform) {
    return platform.name.find("Portable Computing Language") != std::string::npos;
}

DeviceFacts device_facts(const cl::Device& device, const PlatformReport& platform) {
    DeviceFacts facts;
    facts.platform = platform.name;
    facts.platform_version = platform.version;
    facts.is_pocl = is_pocl(platform);
    facts.is_intel = platform.name.find("Intel(R) OpenCL") != std::string::npos;
    ask(facts.problem, [&] { learn_device(device, facts); });
    if (facts.is_pocl) learn_pocl_target(facts);
    if (facts.name.empty()) facts.name = "unnamed device";
    return facts;
}

/// `pocl_problem`: why PoCL, if that is the platform, would end the program when it is used.
Platform open_platform(const cl::Platform& platform, const std::string& pocl_problem) {
    Platform opened;
    PlatformReport& report = opened.report;
    ask(report.problem, [&] { report.name = platform.getInfo<CL_PLATFORM_NAME>(); });
    ask(report.problem, [&] { report.version = platform.getInfo<CL_PLATFORM_VERSION>(); });
    if (is_pocl(report) && report.problem.empty()) report.problem = pocl_problem;
    if (report.problem.empty())
        ask(report.problem, [&] { platform.getDevices(CL_DEVICE_TYPE_ALL, &opened.devices); });
    for (const cl::Device& device : opened.devices)
        report.devices.push_back(device_facts(device, report));
    if (report.name.empty()) report.name = "unnamed platform";
    if (report.devices.empty() && report.problem.empty()) report.problem = "it has no devices";
    return opened;
}

std::vector<Platform> open_platforms() {
    const std::string pocl_problem = prepare_pocl();
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error& error) {
        constexpr cl_int PLATFORM_NOT_FOUND = -1001;
        if (error.err() == PLATFORM_NOT_FOUND) return {};
        return {{{.name = "OpenCL loader", .version{}, .devices{}, .problem = reason(error)}, {}}};
    }
    std::vector<Platform> opened;
    for (const cl::Platform& platform : platforms)
        opened.push_back(open_platform(platform, pocl_problem));
    return opened;
}

std::vector<PlatformReport> reports(const std::vector<Platform>& platforms) {
    std::vector<PlatformReport> all;
    for (const Platform& platform : platforms) all.push_back(platform.report);
    return all;
}

/// The devices of all platforms in one list; its places are what selectors count.
std::vector<DeviceFacts> all_devices(const std::vector<PlatformReport>& platforms) {
    std::vector<DeviceFacts> all;
    for (const PlatformReport& platform : platforms)
        all.insert(all.end(), platform.devices.begin(), platform.devices.end());
    return all;
}

template <class Predicate>
std::optional<size_t> first(const std::vector<DeviceFacts>& devices, Predicate&& matches) {
    const auto found = std::find_if(devices.begin(), devices.end(), matches);
    if (found == devices.end()) return std::nullopt;
    return size_t(found - devices.begin());
}

std::optional<size_t> default_device(const std::vector<DeviceFacts>& devices) {
    const auto usable = [](const DeviceFacts& facts) { return facts.problem.empty(); };
    if (auto gpu = first(devices, [&](auto& facts) { return usable(facts) && facts.is_gpu; }))
        return gpu;
    if (auto cpu = first(devices, [&](auto& facts) { return usable(facts) && facts.is_cpu; }))
        return cpu;
    return first(devices, usable);
}

std::string lower(std::string_view text) {
    std::string result(text);
    for (char& c : result) c = char(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

std::optional<size_t> device_named(const std::vector<DeviceFacts>& devices, std::string_view text) {
    const auto matches = [wanted = lower(text)](const DeviceFacts& facts) {
        return lower(facts.name).find(wanted) != std::string::npos ||
               lower(facts.platform).find(wanted) != std::string::npos;
    };
    const auto usable = [&](auto& facts) { return facts.problem.empty() && matches(facts); };
    if (auto found = first(devices, usable)) return found;
    return first(devices, matches);
}

} // namespace

std::string inventory(const std::vector<PlatformReport>& platforms) {
    std::vector<std::string> lines;
    size_t index = 0;
    for (const PlatformReport& platform : platforms) {
        if (!platform.problem.empty())
            lines.push_back(fmt::format("platform {} ({})", platform.name, platform.problem));
        for (const DeviceFacts& facts : platform.devices) {
            const std::string problem =
                facts.problem.empty() ? "" : fmt::format(", unusable: {}", facts.problem);
            lines.push_back(
                fmt::format("{}: {} on {}{}", index++, facts.name, platform.name, problem));
        }
    }
    return fmt::format("{}", fmt::join(lines, "; "));
}

std::vector<PlatformReport> list_platforms() {
    return reports(open_platforms());
}

std::optional<size_t> choose_device(const std::vector<PlatformReport>& platforms,
                                    std::string_view selector) {
    const std::vector<DeviceFacts> devices = all_devices(platforms);
    if (selector.empty()) return default_device(devices);
    size_t index = 0;
    const auto [end, error] =
        std::from_chars(selector.data(), selector.data() + selector.size(), index);
    const bool is_index = error == std::errc() && end == selector.data() + selector.size();
    // A number beyond the list may still be part of a name, such as "3090", but not "1" of
    // "avx512".
    constexpr size_t DIGITS_OF_NAME = 3;
    if (is_index && index < devices.size()) return index;
    if (is_index && selector.size() < DIGITS_OF_NAME) return std::nullopt;
    return device_named(devices, selector);
}

std::string default_selector() {
    const char* value = std::getenv("ONDE_DEVICE");
    return value ? value : "";
}

Device::Device(cl::Device device, DeviceFacts facts, Profiling profiling)
    : facts_(std::move(facts)), device_(std::move(device)) {
    checked(fmt::format("device {} cannot be opened; choose another", facts_.name), [&] {
        context_ = cl::Context(device_);
        const cl_command_queue_properties timed = CL_QUEUE_PROFILING_ENABLE;
        queue_ = cl::CommandQueue(context_, device_, profiling == Profiling::on ? timed : 0);
    });
}

void Device::finish() const {
    checked(fmt::format("device {} failed while working", facts_.name), [&] { queue_.finish(); });
}

Device open_device(std::string_view selector, Profiling profiling) {
    const std::string by_default = default_selector();
    const char* origin = "";
    if (selector.empty() && !by_default.empty()) {
        selector = by_default;
        origin = " of ONDE_DEVICE";
    }
    const std::vector<Platform> platforms = open_platforms();
    if (platforms.empty()) throw DeviceError(NO_PLATFORM);
    const std::vector<PlatformReport> all = reports(platforms);
    const std::optional<size_t> index = choose_device(all, selector);
    if (!index && selector.empty())
        throw DeviceError("no OpenCL device can be used; there is: {}", inventory(all));
    if (!index)
        throw DeviceError("no OpenCL device matches '{}'{}; choose from: {}", selector, origin,
                          inventory(all));
    const DeviceFacts facts = all_devices(all)[*index];
    if (!facts.problem.empty())
        throw DeviceError("device {} cannot be used ({}); choose from: {}", facts.name,
                          facts.problem, inventory(all));
    std::vector<cl::Device> devices;
    for (const Platform& platform : platforms)
        devices.insert(devices.end(), platform.devices.begin(), platform.devices.end());
    return Device(devices[*index], facts, profiling);
}

} // namespace onde::gpu
