#include "gpu/profiler.h"

#include "gpu/cl_error.h"

namespace onde::gpu {

static double event_seconds(const cl::Event& event) {
    event.wait();
    const cl_ulong start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
    const cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
    return double(end - start) * 1e-9;
}

void Profiler::record(const std::string& kernel, cl::Event event) {
    pending_.emplace_back(kernel, std::move(event));
}

const std::map<std::string, KernelTime>& Profiler::totals() {
    for (const auto& [kernel, event] : pending_) {
        KernelTime& time = totals_[kernel];
        time.seconds += checked(fmt::format("kernel {} failed while running", kernel),
                                [&, &event = event] { return event_seconds(event); });
        ++time.launches;
    }
    pending_.clear();
    return totals_;
}

} // namespace onde::gpu
