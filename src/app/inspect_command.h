// `onde inspect SCENE --pixel X,Y`: what happened to one sample of one pixel.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand; it prints to standard output. Throws InputError and DeviceError.
void add_inspect_command(Command& root);

} // namespace onde::app
