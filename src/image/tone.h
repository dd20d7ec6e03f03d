// From linear light to the bytes of a display and back: pure functions of one value.
#pragma once

#include "image/image_io.h"

#include <cstdint>
#include <vector>

namespace onde {

/// The sRGB transfer curve, IEC 61966-2-1, with its linear toe. 0 and 1 map to themselves; values
/// outside [0, 1] follow the same curve, mirrored below zero.
float srgb_from_linear(float linear);

/// The inverse of srgb_from_linear.
float linear_from_srgb(float encoded);

/// A smooth shoulder for values above 1: a rational fit of the ACES reference curve, applied per
/// channel. From [0, inf] to [0, 1], 0.8 at 1, clipped at 1 beyond 7.2; negative values give 0.
/// Source: K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016 (published as CC0).
float filmic(float linear);

/// Interleaved bytes of `image`, as many channels as it has: exposed, tone mapped, clipped and sRGB
/// encoded; the fourth channel is alpha and only clipped. NaN gives 0.
std::vector<uint8_t> display_bytes(const Image& image, const Display& display);

} // namespace onde
