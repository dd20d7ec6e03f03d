// `onde devices`: what OpenCL offers on this machine.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand, which prints every platform and device, broken ones with their reason, and
/// marks the one that a render takes by default; as JSON with --json.
void add_devices_command(Command& root);

} // namespace onde::app
