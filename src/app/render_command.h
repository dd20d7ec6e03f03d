// `onde render SCENE`: from a scene file to a picture file.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand. Sets `interrupted` when Ctrl-C ended the render (the picture so far is
/// saved). Throws InputError and DeviceError.
void add_render_command(Command& root, bool& interrupted);

} // namespace onde::app
