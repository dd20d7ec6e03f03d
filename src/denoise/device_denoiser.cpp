#include "denoise/device_denoiser.h"

#include "gpu/buffer.h"

#include <algorithm>

namespace onde {
namespace {

/// About what the buffers of a band take.
constexpr uint64_t BAND_BYTES = uint64_t(128) << 20;
constexpr uint32_t ALL_PLANES = NOISY_PLANES + LIMITED_PLANES + GUIDE_PLANES + 3 + AVERAGE_PLANES;

gpu::Program build(gpu::Programs& programs, const DenoiserCut& cut, const char* file,
                   const char* name) {
    return programs.build(
        {file,
         {fmt::format("ONDE_WIDTH={}", cut.width), fmt::format("ONDE_TILE_COLUMNS={}", cut.columns),
          fmt::format("ONDE_TILE_ROWS={}", cut.rows)},
         {{name, cut.group}}});
}

uint32_t parts_of(uint32_t whole, uint32_t part) {
    return (whole + part - 1) / part;
}

} // namespace

DenoiserCut denoiser_cut(const gpu::DeviceFacts& facts, uint32_t picture_width) {
    DenoiserCut cut;
    cut.width = gpu::default_settings(facts).width;
    if (facts.is_cpu)
        cut.columns = DENOISE_COLUMNS, cut.rows = BAND_ROWS;
    else
        cut.group = uint32_t(std::min<size_t>(32, facts.max_work_group_size));
    const uint64_t row = uint64_t(band_of(picture_width, 1, 0, 1).stride) * ALL_PLANES * 4;
    const uint64_t rows = std::clamp<uint64_t>(BAND_BYTES / row, BAND_ROWS, 256);
    cut.band_rows = uint32_t(rows / BAND_ROWS * BAND_ROWS);
    return cut;
}

struct DeviceDenoiser::Buffers {
    gpu::Buffer<DenoiseBand> band;
    gpu::Buffer<float> noisy, limited, guides, target, output;

    Buffers(const gpu::Device& device, size_t plane)
        : band(device, 1), noisy(device, NOISY_PLANES * plane),
          limited(device, LIMITED_PLANES * plane), guides(device, GUIDE_PLANES * plane),
          target(device, 3 * plane), output(device, AVERAGE_PLANES * plane) {
        // Where kernels write nothing, they still read, for lanes that are not kept.
        limited.fill(device, 0.0f);
        guides.fill(device, 0.0f);
    }
};

DeviceDenoiser::DeviceDenoiser(gpu::Programs& programs, const DenoiserCut& cut)
    : device_(programs.device()), cut_(cut),
      limit_(build(programs, cut, "denoise/limit.cl", "limit")),
      guide_(build(programs, cut, "denoise/guide.cl", "guide")),
      average_(build(programs, cut, "denoise/average.cl", "average")) {}

std::vector<float> DeviceDenoiser::average(Buffers& buffers, const DenoiseBand& band,
                                           const Image& target) {
    buffers.target.write(device_, band_planes(band, target));
    const uint32_t across = parts_of(band.width, cut_.columns);
    const uint32_t tiles = across * parts_of(band.rows, cut_.rows);
    gpu::Kernel& kernel = average_.kernel("average");
    kernel.set_from(0, tiles, across, buffers.band, buffers.noisy, buffers.limited, buffers.guides,
                    buffers.target, buffers.output);
    kernel.launch(tiles);
    return buffers.output.read(device_);
}

void DeviceDenoiser::denoise_band(Buffers& buffers, const DenoiseBand& band,
                                  const NoisyPicture& noisy, NoisyPicture& result) {
    buffers.band.write(device_, std::span(&band, 1));
    buffers.noisy.write(device_, band_planes(band, noisy));
    gpu::Kernel& limit = limit_.kernel("limit");
    limit.set_from(0, plane_rows(band), buffers.band, buffers.noisy, buffers.limited);
    limit.launch(plane_rows(band));
    gpu::Kernel& guide = guide_.kernel("guide");
    guide.set_from(0, plane_rows(band), buffers.band, buffers.noisy, buffers.limited,
                   buffers.guides);
    guide.launch(plane_rows(band));
    const std::vector<float> whole = average(buffers, band, noisy.radiance);
    put_band(band, whole, AVERAGE_RADIANCE, result.radiance);
    put_band(band, whole, AVERAGE_VARIANCE, result.variance);
    for (size_t i = 0; i < noisy.parts.size(); ++i)
        put_band(band, average(buffers, band, noisy.parts[i]), AVERAGE_RADIANCE, result.parts[i]);
}

DenoisedPicture DeviceDenoiser::denoise(const NoisyPicture& noisy,
                                        const std::function<bool()>& keep_going) {
    const uint32_t width = noisy.radiance.width, height = noisy.radiance.height;
    Buffers buffers(device_, band_of(width, height, 0, cut_.band_rows).plane);
    NoisyPicture before = noisy, after = noisy;
    for (uint32_t pass = 0; pass < cut_.passes; ++pass) {
        for (uint32_t row = 0; row < height; row += cut_.band_rows) {
            if (keep_going && !keep_going()) break;
            denoise_band(buffers, band_of(width, height, row, cut_.band_rows), before, after);
        }
        before = after;
    }
    return {std::move(after.radiance), std::move(after.parts)};
}

} // namespace onde
