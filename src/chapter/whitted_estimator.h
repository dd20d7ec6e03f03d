// The chapter's recursion: the host's half of kernels/chapter/whitted/estimator.h.
#pragma once

#include "chapter/whitted_scene.h"
#include "render/estimator.h"
#include "render/memory_plan.h"
#include "render/options.h"

namespace onde {

class WhittedEstimator : public Estimator {
  public:
    /// With room for the waiting nodes of settings.wave_size paths, options.depth a path.
    WhittedEstimator(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options);

    const EstimatorShape& shape() const override { return shape_; }
    uint32_t bind(gpu::Kernel& kernel, uint32_t first) const override;

    uint32_t sources() const { return packed_.settings.source_count; }

  private:
    PackedWhitted packed_;
    EstimatorShape shape_;
    uint32_t paths_, stride_;
    gpu::Buffer<WhittedRecord> settings_;
    gpu::Buffer<PhongRecord> phong_;
    gpu::Buffer<SourceRecord> source_records_;
    gpu::Buffer<float> nodes_;
};

/// The options with waves of so few paths that their waiting nodes take 256 MiB at most.
RenderOptions with_room_for_nodes(RenderOptions options);

} // namespace onde
