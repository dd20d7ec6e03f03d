// Pictures of scene files, of which several benches make some.
#pragma once

#include "core/command_line.h"
#include "scene/load.h"

#include <filesystem>
#include <vector>

namespace onde::bench {

struct PictureOptions {
    std::vector<std::filesystem::path> scenes;
    std::filesystem::path environment;
    uint32_t width = 0, height = 0; ///< pixels
};

void add_pictures(Command& command, PictureOptions& options);

/// Throws InputError where the environment can't be read.
LoadOptions load_options(const PictureOptions& options);

} // namespace onde::bench
