// What a driver says of a device, for people and for scripts.
#pragma once

#include "app/json.h"
#include "gpu/device.h"

#include <string>

namespace onde::app {

/// Name, type, units, memory and driver in one line.
std::string device_text(const gpu::DeviceFacts& facts);

Json device_json(const gpu::DeviceFacts& facts);

/// A problem, or null where there is none.
Json problem_json(const std::string& problem);

} // namespace onde::app
