// `onde cache`: the compiled kernels kept on disk.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand with its own subcommands: list, clear and prewarm, which compiles what
/// rendering needs ahead of time. Throws InputError and DeviceError.
void add_cache_command(Command& root);

} // namespace onde::app
