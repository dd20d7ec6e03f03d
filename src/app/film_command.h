// `onde film`: tells what is in a film file.
#pragma once

#include "core/command_line.h"

namespace onde::app {

void add_film_command(Command& root);

} // namespace onde::app
