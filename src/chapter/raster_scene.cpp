#include "chapter/raster_scene.h"

#include "render/frame.h"

namespace onde {
namespace {

/// Of the R2 sequence, as docs/whitted.md defines it.
float sample_offset(uint32_t sample, uint32_t step) {
    return float((0x80000000u + sample * step) >> 8) * 0x1p-24f;
}

} // namespace

RasterBuffers::RasterBuffers(gpu::BufferList& buffers, const PackedRaster& packed)
    : frame(buffers.add<FrameRecord>("frame", 1)),
      record(buffers.add_copy("raster settings", std::vector{packed.record})),
      instances(buffers.add_copy("raster instances", packed.instances)),
      positions(buffers.add_copy("raster vertices", packed.positions)),
      triangles(buffers.add_copy("raster triangles", packed.triangles)),
      triangle_materials(buffers.add_copy("raster triangle materials", packed.triangle_materials)),
      spheres(buffers.add_copy("raster spheres", packed.spheres)),
      materials(buffers.add_copy("raster materials", packed.materials)),
      uvs(buffers.add_copy("raster texture coordinates", packed.uvs)) {}

RasterScene::RasterScene(const IntegratorContext& c, RenderBuffers& buffers)
    : scene_(c.scene), packed_(pack_raster(*c.description, c.camera, c.options)),
      buffers_(buffers.scene, packed_) {
    const FrameRecord frame = make_frame(c.scene.packed(), c.camera, c.options);
    buffers_.frame.write(c.device(), std::span(&frame, 1));
}

void RasterScene::set_sample(uint32_t sample) {
    offset_x_ = sample_offset(sample, 0xC13FA9A9u);
    offset_y_ = sample_offset(sample, 0x91E10DA6u);
}

uint32_t RasterScene::bind(gpu::Kernel& kernel, uint32_t first) const {
    const RasterBuffers& b = buffers_;
    return kernel.set_from(first, b.record, b.instances, b.positions, b.triangles,
                           b.triangle_materials, b.spheres, b.materials, b.uvs, offset_x_,
                           offset_y_);
}

uint32_t RasterScene::bind_scene(gpu::Kernel& kernel, uint32_t first) const {
    kernel.set(first, buffers_.frame);
    return scene_.bind(kernel, first + 1);
}

gpu::Program build_raster(const IntegratorContext& context, const std::string& file,
                          const std::vector<std::pair<std::string, size_t>>& kernels,
                          const std::vector<std::string>& more_defines) {
    gpu::ProgramRequest request;
    request.file = "chapter/raster/" + file;
    request.defines = context.scene.packed().features.defines();
    request.defines.insert(request.defines.end(), more_defines.begin(), more_defines.end());
    for (const auto& [name, items] : kernels)
        request.kernels.push_back({name, context.options.settings.local_size, items});
    return context.programs.build(request);
}

} // namespace onde
