// `onde compare A B`: the distance of a picture from a reference.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Adds the subcommand to `app`. When chosen it prints a table, or JSON with --json, on standard
/// output; throws InputError for pictures that cannot be read or differ in shape.
void add_compare_command(Command& root);

} // namespace onde::app
