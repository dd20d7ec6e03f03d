// Compiling kernels before they are needed.
#pragma once

#include "scene/load_options.h"

#include <string>
#include <vector>

namespace onde::app {

/// Compiles into the cache the kernels that rendering these scene files needs with the default
/// engine and settings or, without scenes, those of a few kinds of scene; prints a line for each.
/// `device` is a selector as of open_device(). Throws InputError and DeviceError.
void prewarm(const std::vector<std::string>& scenes, const std::string& device,
             const LoadOptions& load);

} // namespace onde::app
