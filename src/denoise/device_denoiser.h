// Our own denoiser, on the device: a mean of pixels that are alike (kernels/denoise). Its bits are
// the same at every width, on every device, in bands of any height.
#pragma once

#include "denoise/band.h"
#include "denoise/picture.h"
#include "gpu/program.h"
#include "gpu/settings.h"

#include <functional>

namespace onde {

struct DenoiserCut {
    uint32_t width = 1;             ///< pixels that a work item computes at once, 1, 8 or 16
    uint32_t columns = 4, rows = 4; ///< of a work item's tile, within 32 and 16, which they divide
    uint32_t group = 1;             ///< work items
    uint32_t band_rows = 256;       ///< a multiple of 16
    uint32_t passes = 2;            ///< the later ones filter what noise the first one left
};

/// What suits the device, for pictures of that width.
DenoiserCut denoiser_cut(const gpu::DeviceFacts& facts, uint32_t picture_width);

class DeviceDenoiser {
  public:
    /// Builds its kernels. The programs outlive it.
    DeviceDenoiser(gpu::Programs& programs, const DenoiserCut& cut);

    /// Parts are averaged with the weights of the whole, so that they add up to it. Asks
    /// `keep_going` between bands, and returns what was denoised so far, the rest as it was, where
    /// it says false. Throws DeviceError.
    DenoisedPicture denoise(const NoisyPicture& noisy,
                            const std::function<bool()>& keep_going = {});

  private:
    struct Buffers;
    std::vector<float> average(Buffers& buffers, const DenoiseBand& band, const Image& target);
    void denoise_band(Buffers& buffers, const DenoiseBand& band, const NoisyPicture& noisy,
                      NoisyPicture& result);

    const gpu::Device& device_;
    DenoiserCut cut_;
    gpu::Program limit_, guide_, average_;
};

} // namespace onde
