// An open device and the programs on it: what sessions, measurements and tests run on.
#pragma once

#include "gpu/program.h"

namespace onde {

struct Machine {
    gpu::Device device;
    gpu::Programs programs;

    /// Opens the device that `selector` names (see gpu::open_device). Without a cache, kernels are
    /// compiled anew in each run. Throws DeviceError.
    explicit Machine(std::string_view selector = {},
                     gpu::KernelSources sources = gpu::KernelSources::embedded(),
                     std::optional<gpu::ProgramCache> cache = gpu::ProgramCache(),
                     gpu::Profiling profiling = gpu::Profiling::off)
        : Machine(gpu::open_device(selector, profiling), std::move(sources), std::move(cache)) {}
    Machine(gpu::Device opened, gpu::KernelSources sources, std::optional<gpu::ProgramCache> cache)
        : device(std::move(opened)), programs(device, std::move(sources), std::move(cache)) {}
    Machine(const Machine&) = delete; // the programs refer to the device
    Machine& operator=(const Machine&) = delete;
};

} // namespace onde
