// A picture that is denoised on a device is cut into bands of rows, so that neither its memory nor
// a launch grows with the picture. Here a band is laid out as kernels/shared/denoise.h says.
#pragma once

#include "denoise/picture.h"

#include "shared/denoise.h"

#include <vector>

namespace onde {

/// Rows of a band are rounded up to a multiple of this, of which tiles take a part.
inline constexpr uint32_t BAND_ROWS = 16;

/// The layout of the band from that row on, of at most `rows` rows.
DenoiseBand band_of(uint32_t width, uint32_t height, uint32_t first_row, uint32_t rows);

/// Rows of a plane, with those around.
uint32_t plane_rows(const DenoiseBand& band);

/// Three planes of it; beyond the edges the picture is mirrored. Values that no picture has are
/// brought into a range whose squares are floats.
std::vector<float> band_planes(const DenoiseBand& band, const Image& image);

/// The NOISY_PLANES.
std::vector<float> band_planes(const DenoiseBand& band, const NoisyPicture& noisy);

/// Three planes, from that number on, back into the rows of the band.
void put_band(const DenoiseBand& band, const std::vector<float>& planes, uint32_t first,
              Image& image);

} // namespace onde
