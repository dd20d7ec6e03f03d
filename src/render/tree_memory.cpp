#include "render/tree_memory.h"

#include <algorithm>

namespace onde {
namespace {

constexpr uint32_t NODE_LANES = 22;    // as in kernels/wavefront/tree_state.h
constexpr uint32_t LEVEL_WORDS = 3;    // TreeLevel of kernels/wavefront/tree_staged.cl
constexpr uint32_t LANE_PADDING = 272; // lanes a power of two apart would share cache sets

/// How many elements the buffers have.
struct Sizes {
    uint32_t items, capacity, stride;
    size_t nodes, levels;

    explicit Sizes(const RenderOptions& options) {
        const gpu::DeviceSettings& s = options.settings;
        const bool stored = options.engine == Engine::wavefront;
        items = s.wave_size / s.chunk;
        capacity = stored ? s.chunk * options.tree_slots : 0; // a multiple of the width
        stride = items * capacity + LANE_PADDING;
        nodes = stored ? size_t(stride) * NODE_LANES : 1;
        const bool staged = stored && s.launch == gpu::Launch::staged;
        levels = staged ? size_t(items) * (level_capacity(options.depth) + 1) * LEVEL_WORDS : 1;
    }
};

} // namespace

TreeMemory::TreeMemory(gpu::BufferList& buffers, const RenderOptions& options,
                       const PackedWhitted& scene)
    : chunk_(options.settings.chunk), stride_(Sizes(options).stride),
      capacity_(Sizes(options).capacity),
      settings_(buffers.add_copy("Whitted settings", std::vector{scene.settings})),
      phong_(buffers.add_copy("Phong materials", scene.phong)),
      sources_(buffers.add_copy("light sources", scene.sources)),
      unfinished_(buffers.add<uint32_t>("unfinished paths", Sizes(options).items)),
      levels_(buffers.add<uint32_t>("tree levels", Sizes(options).levels)),
      nodes_(buffers.add<float>("ray trees", Sizes(options).nodes)) {}

void TreeMemory::bind(gpu::Kernel& kernel, uint32_t first, uint32_t level) const {
    kernel.set_from(first, settings_, phong_, sources_, unfinished_, nodes_, levels_, stride_,
                    capacity_, level);
}

void TreeMemory::begin(gpu::Program& program, uint32_t paths) const {
    gpu::Kernel& kernel = program.kernel("tree_begin");
    const uint32_t items = (paths + chunk_ - 1) / chunk_;
    kernel.set_from(0, items, unfinished_, chunk_, paths);
    kernel.launch(items);
}

bool TreeMemory::is_unfinished(const gpu::Device& device, uint32_t paths) const {
    const uint32_t items = (paths + chunk_ - 1) / chunk_;
    const std::vector<uint32_t> first = unfinished_.read(device, 0, items);
    for (uint32_t i = 0; i < items; i++)
        if (first[i] < std::min((i + 1) * chunk_, paths)) return true;
    return false;
}

} // namespace onde
