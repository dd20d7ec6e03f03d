// Which primitives may touch which tile of the picture, in the order of painting.
#pragma once

#include "chapter/raster_scene.h"

namespace onde {

/// The grid of tiles over a picture, and room for the lists.
struct TileBuffers {
    uint32_t across, down, most_blocks;
    gpu::Buffer<uint32_t> table, totals, begins, lists;
    gpu::Buffer<cl_ushort4> touched;

    /// most_entries: of all lists together; raised where one primitive could need more.
    TileBuffers(gpu::BufferList& buffers, const RasterRecord& record, uint32_t most_entries);

    uint32_t count() const { return across * down; }
};

class RasterTiles {
  public:
    /// The device outlives it.
    RasterTiles(const gpu::Device& device, TileBuffers buffers)
        : device_(device), buffers_(std::move(buffers)) {}

    uint32_t count() const { return buffers_.count(); }
    uint32_t across() const { return buffers_.across; }
    /// The most primitives of one list.
    uint32_t most_primitives() const;
    /// The most work items of a launch.
    uint32_t most_blocks() const { return buffers_.most_blocks; }

    /// Finds the tiles that each primitive touches, at the scene's sample; once before list().
    void find(gpu::Program& program, const RasterScene& scene, uint32_t chunk,
              gpu::Profiler* profiler);

    /// Lists the primitives order[first], order[first + 1], ... by tile: as many of them as there
    /// is room for, at most `count`, at least one. Returns how many.
    uint32_t list(gpu::Program& program, const gpu::Buffer<uint32_t>& order, uint32_t first,
                  uint32_t count, gpu::Profiler* profiler);

    /// Where the list of each tile begins, and the end of the last one; and the lists.
    const gpu::Buffer<uint32_t>& begins() const { return buffers_.begins; }
    const gpu::Buffer<uint32_t>& lists() const { return buffers_.lists; }

  private:
    /// Returns the length of all lists together.
    uint64_t count_entries(gpu::Program& program, const gpu::Buffer<uint32_t>& order,
                           uint32_t first, uint32_t count, gpu::Profiler* profiler);
    uint32_t block(uint32_t count) const { return (count + most_blocks() - 1) / most_blocks(); }

    const gpu::Device& device_;
    TileBuffers buffers_;
};

} // namespace onde
