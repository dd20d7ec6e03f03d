// What a NanoVDB file is around its grids.
#pragma once

#include "scene/grid/bytes.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace onde {

class LoadContext;

/// A grid as the file has it.
struct StoredGrid {
    std::string name;
    uint32_t type;                 ///< of its values
    uint16_t codec;                ///< how it is compressed
    uint64_t offset, stored, size; ///< bytes in the file, and once they are unpacked
};

/// The first that is called "density", else the first of all. Throws InputError for what is no
/// NanoVDB file.
StoredGrid choose_grid(const Bytes& file);

/// The bytes of a grid: in the file, or in `room`, which is spent before it grows. Throws
/// InputError for what can't be unpacked.
std::string_view unpacked(LoadContext& context, const std::string& name, const Bytes& file,
                          const StoredGrid& grid, std::string& room);

} // namespace onde
