#include "render/film.h"

#include "shared/frame.h"

namespace onde {

Film::Film(const gpu::Device& device, uint32_t width, uint32_t height)
    : width_(width), height_(height), sums_(device, size_t(width) * height),
      invalid_(device, INVALID_SIZE) {
    sums_.fill(device, cl_float4{});
    invalid_.fill(device, 0u);
}

Image Film::develop(const gpu::Device& device) const {
    const std::vector<cl_float4> sums = sums_.read(device);
    Image image(width_, height_, 3);
    for (size_t i = 0; i < sums.size(); i++)
        for (size_t k = 0; k < 3; k++)
            image.pixels[3 * i + k] = sums[i].s[3] > 0 ? sums[i].s[k] / sums[i].s[3] : 0.0f;
    return image;
}

Film::Invalid Film::find_invalid(const gpu::Device& device) const {
    const std::vector<uint32_t> words = invalid_.read(device);
    return {words[INVALID_COUNT], words[INVALID_PIXEL] & 0xffff, words[INVALID_PIXEL] >> 16,
            words[INVALID_SAMPLE]};
}

} // namespace onde
