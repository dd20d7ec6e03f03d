// The memory of the Whitted estimator's ray trees; its layout is kernels/wavefront/tree_state.h.
#pragma once

#include "gpu/buffer_list.h"
#include "gpu/program.h"
#include "render/options.h"
#include "upload/whitted.h"

namespace onde {

class TreeMemory {
  public:
    /// Arenas for settings.wave_size / settings.chunk work items, or none for the megakernel.
    TreeMemory(gpu::BufferList& buffers, const RenderOptions& options, const PackedWhitted& scene);

    static constexpr uint32_t PARAMETERS = 9;
    /// Binds TREE_PARAMETERS of kernels/chapter/whitted/parameters.h from `first` on.
    void bind(gpu::Kernel& kernel, uint32_t first, uint32_t level) const;
    /// Marks all paths of a wave as not done.
    void begin(gpu::Program& program, uint32_t paths) const;
    /// Whether some path of the wave is still to be done. Waits for the device.
    bool is_unfinished(const gpu::Device& device, uint32_t paths) const;

  private:
    uint32_t chunk_, stride_, capacity_;
    gpu::Buffer<WhittedRecord> settings_;
    gpu::Buffer<PhongRecord> phong_;
    gpu::Buffer<SourceRecord> sources_;
    gpu::Buffer<uint32_t> unfinished_, levels_;
    gpu::Buffer<float> nodes_;
};

} // namespace onde
