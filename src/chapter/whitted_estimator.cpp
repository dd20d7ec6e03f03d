#include "chapter/whitted_estimator.h"

#include "shared/columns.h"

namespace onde {
namespace {

/// Columns a power of two apart would share cache sets.
constexpr uint32_t COLUMN_PADDING = 272;

/// A node: its ray, its hit and the child that is next (NODE_COLUMNS).
constexpr uint64_t NODE_WORDS = COLUMN_COUNT(WHITTED_COLUMNS) + COLUMN_COUNT(HIT_COLUMNS) + 1;

uint32_t stride(const RenderOptions& options) {
    return options.settings.wave_size * options.depth + COLUMN_PADDING;
}

EstimatorShape make_shape(const PackedWhitted& scene) {
    uint32_t connections = 0;
    for (const SourceRecord& source : scene.sources) connections += source.samples * source.samples;
    return {.file = "chapter/whitted/estimator.h",
            .defines = scene.defines(),
            .state_columns = COLUMN_COUNT(WHITTED_COLUMNS),
            .connection_columns = COLUMN_COUNT(CONNECTION_COLUMNS),
            .is_tree = true,
            .connections = connections};
}

} // namespace

WhittedEstimator::WhittedEstimator(RenderBuffers& buffers, const Scene& scene,
                                   const RenderOptions& options)
    : packed_(pack_whitted(scene, options.depth)), shape_(make_shape(packed_)),
      paths_(options.settings.wave_size), stride_(stride(options)),
      settings_(buffers.scene.add_copy("Whitted settings", std::vector{packed_.settings})),
      phong_(buffers.scene.add_copy("Phong materials", packed_.phong)),
      source_records_(buffers.scene.add_copy("light sources", packed_.sources)),
      nodes_(buffers.paths.add<float>("waiting nodes", size_t(stride_) * NODE_WORDS)) {}

uint32_t WhittedEstimator::bind(gpu::Kernel& kernel, uint32_t first) const {
    return kernel.set_from(first, settings_, phong_, source_records_, nodes_, stride_, paths_);
}

RenderOptions with_room_for_nodes(RenderOptions options) {
    constexpr uint64_t MOST_BYTES = uint64_t(256) << 20;
    gpu::DeviceSettings& s = options.settings;
    const auto bytes = [&] { return stride(options) * NODE_WORDS * sizeof(float); };
    while (bytes() > MOST_BYTES && s.wave_size / 2 >= s.chunk && s.wave_size / 2 % s.chunk == 0)
        s.wave_size /= 2;
    return options;
}

} // namespace onde
