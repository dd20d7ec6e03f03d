// `onde merge`: film files of one picture become one film, or the picture.
#pragma once

#include "core/command_line.h"

namespace onde::app {

/// Sets `interrupted` where a merge was told to end.
void add_merge_command(Command& root, bool& interrupted);

} // namespace onde::app
