#include "chapter/raster_tiles.h"

#include <algorithm>

namespace onde {
namespace {

constexpr uint32_t MOST_COUNTERS = 1u << 22;
constexpr uint32_t MOST_BLOCKS = 1024;
constexpr uint64_t MOST_PRIMITIVES = 1u << 20;

uint32_t tiles_along(uint32_t pixels) {
    return (pixels + RASTER_TILE - 1) / RASTER_TILE;
}

} // namespace

TileBuffers::TileBuffers(gpu::BufferList& buffers, const RasterRecord& record,
                         uint32_t most_entries)
    : across(tiles_along(record.width)), down(tiles_along(record.height)),
      most_blocks(std::clamp(MOST_COUNTERS / count(), 1u, MOST_BLOCKS)),
      table(buffers.add<uint32_t>("tile counts", size_t(most_blocks) * count())),
      totals(buffers.add<uint32_t>("tile totals", count())),
      begins(buffers.add<uint32_t>("tile begins", count() + 1)),
      lists(buffers.add<uint32_t>("tile lists", std::max(most_entries, count()))),
      touched(buffers.add<cl_ushort4>("touched tiles", record.primitive_count)) {}

uint32_t RasterTiles::most_primitives() const {
    return uint32_t(std::min(MOST_PRIMITIVES, UINT32_MAX / uint64_t(count()))); // counts fit
}

void RasterTiles::find(gpu::Program& program, const RasterScene& scene, uint32_t chunk,
                       gpu::Profiler* profiler) {
    const uint32_t count = scene.primitives();
    gpu::Kernel& kernel = program.kernel("find_tiles");
    kernel.set_from(0, count, chunk);
    kernel.set_from(scene.bind(kernel, 2), buffers_.touched);
    kernel.launch((size_t(count) + chunk - 1) / chunk, profiler);
}

uint32_t RasterTiles::list(gpu::Program& program, const gpu::Buffer<uint32_t>& order,
                           uint32_t first, uint32_t count, gpu::Profiler* profiler) {
    count = std::min(count, most_primitives());
    while (count_entries(program, order, first, count, profiler) > buffers_.lists.size())
        count /= 2;
    gpu::Kernel& fill = program.kernel("fill_tiles");
    fill.set_from(0, count, block(count), first, order, buffers_.touched, buffers_.across,
                  this->count(), buffers_.table, buffers_.begins, buffers_.lists);
    fill.launch((count + block(count) - 1) / block(count), profiler);
    return count;
}

uint64_t RasterTiles::count_entries(gpu::Program& program, const gpu::Buffer<uint32_t>& order,
                                    uint32_t first, uint32_t count, gpu::Profiler* profiler) {
    const uint32_t blocks = (count + block(count) - 1) / block(count);
    gpu::Kernel& counting = program.kernel("count_tiles");
    counting.set_from(0, count, block(count), first, order, buffers_.touched, buffers_.across,
                      this->count(), buffers_.table);
    counting.launch(blocks, profiler);
    gpu::Kernel& scan = program.kernel("scan_columns");
    scan.set_from(0, this->count(), blocks, buffers_.table, buffers_.totals);
    scan.launch(this->count(), profiler);

    std::vector<uint32_t> begins{0};
    uint64_t sum = 0;
    for (uint32_t total : buffers_.totals.read(device_)) {
        sum += total;
        begins.push_back(uint32_t(sum));
    }
    buffers_.begins.write(device_, begins);
    return sum;
}

} // namespace onde
