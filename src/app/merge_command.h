// `onde merge`: film files of one picture become one film, or the picture.
#pragma once

#include "core/command_line.h"

namespace onde::app {

void add_merge_command(Command& root);

} // namespace onde::app
