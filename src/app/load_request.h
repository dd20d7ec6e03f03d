// What the user asked of the loading of scenes. Every command that loads one has these options.
#pragma once

#include "core/command_line.h"

#include "scene/load_options.h"

#include <optional>

namespace onde::app {

struct LoadRequest {
    LoadOptions options;
    std::optional<double> limit, texture_memory; ///< of the options, in GiB
};

void declare_load(Command& command, LoadRequest& request);

/// The options with all that was asked. Throws InputError for values that are wrong whatever the
/// scene is.
LoadOptions load_options(const LoadRequest& request);

} // namespace onde::app
