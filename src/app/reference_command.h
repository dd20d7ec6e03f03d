// `onde reference`: the keys of scene files, as the tables of docs/scene-format.md show them.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand; it prints to standard output.
void add_reference_command(Command& root);

} // namespace onde::app
