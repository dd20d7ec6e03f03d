// Time per kernel name, from OpenCL events.
#pragma once

#include <CL/opencl.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace onde::gpu {

struct KernelTime {
    uint64_t launches = 0;
    double seconds = 0;
};

/// Collects the events of launches and adds them up by name. Costs nothing when not asked for: give
/// kernels a null profiler.
class Profiler {
  public:
    void record(const std::string& kernel, cl::Event event);
    /// Waits for the recorded events and returns the totals so far.
    const std::map<std::string, KernelTime>& totals();

  private:
    std::vector<std::pair<std::string, cl::Event>> pending_;
    std::map<std::string, KernelTime> totals_;
};

} // namespace onde::gpu
