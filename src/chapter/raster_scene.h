// The primitives of a scene on the device, for the depth buffer and the painter.
#pragma once

#include "chapter/raster_geometry.h"
#include "render/engine.h"
#include "render/integrator.h"

namespace onde {

/// The packed primitives in device memory.
struct RasterBuffers {
    gpu::Buffer<FrameRecord> frame;
    gpu::Buffer<RasterRecord> record;
    gpu::Buffer<RasterInstance> instances;
    gpu::Buffer<float> positions;
    gpu::Buffer<uint32_t> triangles, triangle_materials;
    gpu::Buffer<RasterSphere> spheres;
    gpu::Buffer<RasterMaterial> materials;
    gpu::Buffer<float> uvs;

    RasterBuffers(gpu::BufferList& buffers, const PackedRaster& packed);
};

class RasterScene {
  public:
    RasterScene(const IntegratorContext& context, RenderBuffers& buffers);

    /// The sample of every pixel that kernels draw, once they are bound after this.
    void set_sample(uint32_t sample);

    /// Binds RASTER_PARAMETERS of kernels/chapter/raster/view.h from argument `first` on; returns
    /// the next.
    uint32_t bind(gpu::Kernel& kernel, uint32_t first) const;
    /// Binds SCENE_PARAMETERS of kernels/shade/scene_view.h from argument `first` on.
    uint32_t bind_scene(gpu::Kernel& kernel, uint32_t first) const;

    const RasterRecord& record() const { return packed_.record; }
    uint32_t primitives() const { return packed_.record.primitive_count; }
    const std::vector<std::string>& notes() const { return packed_.notes; }

  private:
    const DeviceScene& scene_;
    PackedRaster packed_;
    RasterBuffers buffers_;
    float offset_x_ = 0.5f, offset_y_ = 0.5f;
};

/// The program kernels/chapter/raster/`file` for the scene: kernels by name, with the most work
/// items that a launch of each will have.
gpu::Program build_raster(const IntegratorContext& context, const std::string& file,
                          const std::vector<std::pair<std::string, size_t>>& kernels,
                          const std::vector<std::string>& more_defines = {});

} // namespace onde
