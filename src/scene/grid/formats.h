// The file formats of grids.
#pragma once

#include "scene/grid.h"

#include <string_view>

namespace onde {

/// NanoVDB: the first grid of the file that is called "density", else the first. Of floats, or of
/// floats in 1 to 16 bits.
DensityGrid read_nanovdb(LoadContext& context, const std::string& name, std::string_view bytes);

/// Mitsuba's gridvolume: floats or bytes; of several channels the first.
DensityGrid read_vol(LoadContext& context, const std::string& name, std::string_view bytes);

} // namespace onde
