#include "denoise/band.h"

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

constexpr float MOST = 1e15f;

uint32_t round_up(uint32_t value, uint32_t step) {
    return (value + step - 1) / step * step;
}

/// The pixel of a row or column of `count` that stands for number i of it.
size_t mirrored(int64_t i, int64_t count) {
    if (i < 0) i = -i;
    if (i >= count) i = 2 * count - 2 - i;
    return size_t(std::clamp<int64_t>(i, 0, count - 1));
}

float bounded(float value) {
    return std::isnan(value) ? 0.0f : std::clamp(value, -MOST, MOST);
}

void append(const DenoiseBand& band, const Image& image, std::vector<float>& planes) {
    for (uint32_t channel = 0; channel < image.channels; ++channel)
        for (uint32_t row = 0; row < plane_rows(band); ++row) {
            const int64_t y = int64_t(band.first_row) + row - DENOISE_ROWS_AROUND;
            const float* pixels =
                &image.pixels[mirrored(y, image.height) * image.width * image.channels + channel];
            for (uint32_t column = 0; column < band.stride; ++column)
                planes.push_back(bounded(
                    pixels[image.channels *
                           mirrored(int64_t(column) - DENOISE_COLUMNS_BEFORE, image.width)]));
        }
}

} // namespace

DenoiseBand band_of(uint32_t width, uint32_t height, uint32_t first_row, uint32_t rows) {
    DenoiseBand band{.width = width,
                     .height = height,
                     .first_row = first_row,
                     .rows = std::min(rows, height - first_row),
                     .stride = round_up(width, DENOISE_COLUMNS) + DENOISE_COLUMNS_BEFORE +
                               DENOISE_COLUMNS_BEHIND,
                     .plane = 0};
    band.plane = band.stride * plane_rows(band);
    return band;
}

uint32_t plane_rows(const DenoiseBand& band) {
    return round_up(band.rows, BAND_ROWS) + 2 * DENOISE_ROWS_AROUND;
}

std::vector<float> band_planes(const DenoiseBand& band, const Image& image) {
    std::vector<float> planes;
    planes.reserve(size_t(image.channels) * band.plane);
    append(band, image, planes);
    return planes;
}

std::vector<float> band_planes(const DenoiseBand& band, const NoisyPicture& noisy) {
    std::vector<float> planes;
    planes.reserve(size_t(NOISY_PLANES) * band.plane);
    for (const Image* image :
         {&noisy.radiance, &noisy.variance, &noisy.albedo, &noisy.normal, &noisy.depth})
        append(band, *image, planes);
    return planes;
}

void put_band(const DenoiseBand& band, const std::vector<float>& planes, uint32_t first,
              Image& image) {
    for (uint32_t row = 0; row < band.rows; ++row)
        for (uint32_t x = 0; x < band.width; ++x)
            for (uint32_t channel = 0; channel < 3; ++channel)
                image.pixel(x, band.first_row + row)[channel] =
                    planes[size_t(first + channel) * band.plane +
                           size_t(row + DENOISE_ROWS_AROUND) * band.stride +
                           DENOISE_COLUMNS_BEFORE + x];
}

} // namespace onde
