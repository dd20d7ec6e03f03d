// Which primitives may touch which tile of the picture, in the order of painting.
#pragma once

#include "chapter/raster_scene.h"

namespace onde {

class RasterTiles {
  public:
    static constexpr uint32_t TILE =
        64; ///< pixels along a side, as in kernels/chapter/raster/painter.cl

    /// most_entries: of all lists together; raised where one primitive could need more.
    RasterTiles(const gpu::Device& device, const RasterRecord& record, uint32_t most_entries);

    uint32_t count() const { return across_ * down_; }
    uint32_t across() const { return across_; }
    /// The most primitives of one list.
    uint32_t most_primitives() const;
    /// The most work items of a launch.
    uint32_t most_blocks() const { return most_blocks_; }

    /// Finds the tiles that each primitive touches, at the scene's sample; once before list().
    void find(gpu::Program& program, const RasterScene& scene, uint32_t chunk,
              gpu::Profiler* profiler);

    /// Lists the primitives order[first], order[first + 1], ... by tile: as many of them as there
    /// is room for, at most `count`, at least one. Returns how many.
    uint32_t list(gpu::Program& program, const gpu::Buffer<uint32_t>& order, uint32_t first,
                  uint32_t count, gpu::Profiler* profiler);

    /// Where the list of each tile begins, and the end of the last one; and the lists.
    const gpu::Buffer<uint32_t>& begins() const { return begins_; }
    const gpu::Buffer<uint32_t>& lists() const { return lists_; }

    uint64_t bytes() const;

  private:
    /// Returns the length of all lists together.
    uint64_t count_entries(gpu::Program& program, const gpu::Buffer<uint32_t>& order,
                           uint32_t first, uint32_t count, gpu::Profiler* profiler);
    uint32_t block(uint32_t count) const { return (count + most_blocks_ - 1) / most_blocks_; }

    const gpu::Device& device_;
    uint32_t across_, down_, most_blocks_;
    gpu::Buffer<uint32_t> table_, totals_, begins_, lists_;
    gpu::Buffer<cl_ushort4> touched_;
};

} // namespace onde
