// Which OpenCL devices there are, what they can do, and the one that we opened.
#pragma once

#include <CL/opencl.hpp>

#include <atomic>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde::gpu {

/// What we know of a device, asked once.
struct DeviceFacts {
    std::string name, vendor, driver_version;
    std::string platform, platform_version;
    bool is_cpu = false, is_gpu = false; ///< not both
    bool is_pocl = false, is_intel = false;
    bool avx2 = false, avx512 = false; ///< of the host and PoCL's target, on a CPU
    bool unified_memory = false;       ///< the host's memory is the device's own
    uint32_t compute_units = 0;
    uint64_t global_memory = 0;  ///< bytes
    uint64_t cache = 0;          ///< bytes of the largest one between it and the units
    uint64_t max_allocation = 0; ///< bytes in one buffer
    size_t max_work_group_size = 1;
    bool correctly_rounded_divide_sqrt = false;
    bool int64_atomics = false; ///< cl_khr_int64_extended_atomics: 64-bit minimum and the like
    std::string problem;        ///< empty, or why it can't be used

    /// Whether code in vectors of 8 or 16 stays such; other compilers take it apart, number by
    /// number.
    bool keeps_vectors() const { return is_cpu && (is_pocl || is_intel); }
    /// Work items of a group where each follows rays of its own: Intel's compiler for CPUs mixes up
    /// the stacks of a group's.
    uint32_t tracing_group() const { return is_cpu && is_intel ? 1 : 64; }
};

struct PlatformReport {
    std::string name, version;
    std::vector<DeviceFacts> devices;
    std::string problem; ///< empty, or why the platform can't be used
};

/// What to tell a user whose machine has no OpenCL platform at all.
inline constexpr const char* NO_PLATFORM =
    "no OpenCL platform is installed; install a driver for your GPU, or for the CPU the Debian "
    "package pocl-opencl-icd";

/// "0: NAME on PLATFORM; 1: ..., unusable: why": what there is, for an error's sentence.
std::string inventory(const std::vector<PlatformReport>& platforms);

/// Every platform and device of the ICD loader, in the loader's order. A platform that fails is
/// listed with its problem. Never throws for a broken platform.
std::vector<PlatformReport> list_platforms();

/// Whether launches can be timed (see Profiler); drivers are slower where they can.
enum class Profiling { off, on };

/// An open device with its context and an in-order queue. Move-only.
class Device {
  public:
    /// Throws DeviceError when the driver refuses.
    Device(cl::Device device, DeviceFacts facts, Profiling profiling = Profiling::off);
    Device(Device&&) = default;
    Device& operator=(Device&&) = default;

    const DeviceFacts& facts() const { return facts_; }
    const cl::Device& raw() const { return device_; }
    const cl::Context& context() const { return context_; }
    const cl::CommandQueue& queue() const { return queue_; }
    /// Waits for all that was queued. Throws DeviceError.
    void finish() const;

    /// The sum of all buffers that were ever allocated on it.
    uint64_t allocated_bytes() const { return *allocated_; }
    void count_allocation(uint64_t bytes) const { *allocated_ += bytes; }

  private:
    DeviceFacts facts_;
    cl::Device device_;
    cl::Context context_;
    cl::CommandQueue queue_;
    std::unique_ptr<std::atomic<uint64_t>> allocated_ = std::make_unique<std::atomic<uint64_t>>(0);
};

/// The place, counted through all platforms, of the device with that index ("0"), or whose name or
/// platform contains the text (case-insensitive; usable ones first), or for an empty selector of
/// the first usable GPU, then CPU, then anything. Nothing when there is none. The device found by a
/// selector may have a problem.
std::optional<size_t> choose_device(const std::vector<PlatformReport>& platforms,
                                    std::string_view selector = {});

/// What an empty selector stands for: the value of the environment variable ONDE_DEVICE, or empty.
std::string default_selector();

/// Opens the device that choose_device() picks from list_platforms(), for an empty selector by
/// default_selector(). Throws DeviceError with the list of what there is when nothing matches or
/// the device that matches has a problem.
Device open_device(std::string_view selector = {}, Profiling profiling = Profiling::off);

} // namespace onde::gpu
