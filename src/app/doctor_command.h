// `onde doctor`: whether a device computes what it should.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand. Sets `unfit` when a check failed, `interrupted` when Ctrl-C ended it.
/// Throws InputError and DeviceError.
void add_doctor_command(Command& root, bool& unfit, bool& interrupted);

} // namespace onde::app
