#include "chapter/raster_scene.h"

#include "render/frame.h"

namespace onde {
namespace {

template <class T>
gpu::Buffer<T> copy(const gpu::Device& device, const std::vector<T>& values) {
    return gpu::Buffer<T>(device, std::span<const T>(values));
}

/// Of the R2 sequence, as docs/whitted.md defines it.
float sample_offset(uint32_t sample, uint32_t step) {
    return float((0x80000000u + sample * step) >> 8) * 0x1p-24f;
}

} // namespace

RasterScene::RasterScene(const IntegratorContext& c)
    : scene_(c.scene), packed_(pack_raster(*c.description, c.camera, c.options)),
      frame_(c.device(), 1), record_(c.device(), std::span<const RasterRecord>(&packed_.record, 1)),
      instances_(copy(c.device(), packed_.instances)),
      positions_(copy(c.device(), packed_.positions)),
      triangles_(copy(c.device(), packed_.triangles)),
      triangle_materials_(copy(c.device(), packed_.triangle_materials)),
      spheres_(copy(c.device(), packed_.spheres)), materials_(copy(c.device(), packed_.materials)),
      uvs_(copy(c.device(), packed_.uvs)) {
    const FrameRecord frame = make_frame(c.scene.packed(), c.camera, c.options);
    frame_.write(c.device(), std::span(&frame, 1));
}

void RasterScene::set_sample(uint32_t sample) {
    offset_x_ = sample_offset(sample, 0xC13FA9A9u);
    offset_y_ = sample_offset(sample, 0x91E10DA6u);
}

uint32_t RasterScene::bind(gpu::Kernel& kernel, uint32_t first) const {
    return kernel.set_from(first, record_, instances_, positions_, triangles_, triangle_materials_,
                           spheres_, materials_, uvs_, offset_x_, offset_y_);
}

uint32_t RasterScene::bind_scene(gpu::Kernel& kernel, uint32_t first) const {
    kernel.set(first, frame_);
    return scene_.bind(kernel, first + 1);
}

uint64_t RasterScene::bytes() const {
    const auto size = [](const auto& buffer) { return buffer.size() * sizeof(uint32_t); };
    return size(positions_) + size(triangles_) + size(triangle_materials_) + size(uvs_) +
           instances_.size() * sizeof(RasterInstance) + spheres_.size() * sizeof(RasterSphere) +
           materials_.size() * sizeof(RasterMaterial);
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
