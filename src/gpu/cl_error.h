// OpenCL's error numbers as names, and its exceptions as ours.
#pragma once

#include "core/error.h"

#include <CL/opencl.hpp>

#include <string>
#include <string_view>

namespace onde::gpu {

/// The number's name in the OpenCL headers, for example "CL_INVALID_VALUE".
std::string error_name(cl_int error);

/// Calls `call` and returns what it returns. A cl::Error becomes a DeviceError:
/// "<what> (<function>: <error name>)".
template <class Call>
auto checked(std::string_view what, Call&& call) {
    try {
        return call();
    } catch (const cl::Error& error) {
        throw DeviceError("{} ({}: {})", what, error.what(), error_name(error.err()));
    }
}

} // namespace onde::gpu
