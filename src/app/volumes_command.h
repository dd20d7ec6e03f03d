// `onde volumes SCENE`: the bounding-volume laboratory (C12, C13).
#pragma once

#include "core/command_line.h"

namespace onde::app {

void add_volumes_command(Command& root);

} // namespace onde::app
