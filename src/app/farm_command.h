// `onde farm`: job files for schedulers, and how far the workers are.
#pragma once

#include "core/command_line.h"

namespace onde::app {

void add_farm_command(Command& root);

} // namespace onde::app
