// `onde work`: a worker's part of a picture that many share by a folder. `onde farm`: how far it
// is.
#pragma once

#include "core/command_line.h"

namespace onde::app {

void add_work_command(Command& root, bool& interrupted);

} // namespace onde::app
