// The film: per pixel, linear sums of radiance and how many samples they hold.
#pragma once

#include "gpu/buffer.h"
#include "image/image.h"

#include <CL/cl_platform.h>

#include <cstdint>

namespace onde {

class Film {
  public:
    /// A black film of width x height pixels on the device.
    Film(const gpu::Device& device, uint32_t width, uint32_t height);

    const gpu::Buffer<cl_float4>& sums() const { return sums_; }
    const gpu::Buffer<uint32_t>& invalid() const { return invalid_; }

    /// The mean radiance so far, 3 channels; pixels without a sample are black.
    Image develop(const gpu::Device& device) const;

    /// Samples that were thrown away because their radiance was not finite, and the first of them.
    struct Invalid {
        uint32_t count = 0, x = 0, y = 0, sample = 0;
    };
    Invalid find_invalid(const gpu::Device& device) const;

  private:
    uint32_t width_, height_;
    gpu::Buffer<cl_float4> sums_;
    gpu::Buffer<uint32_t> invalid_;
};

} // namespace onde
