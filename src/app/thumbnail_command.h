// `onde thumbnail`: a small picture of each of many files, by one process on one device.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Sets `interrupted` when Ctrl-C ended it.
void add_thumbnail_command(Command& root, bool& interrupted);

} // namespace onde::app
