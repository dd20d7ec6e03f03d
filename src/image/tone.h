// From linear light to the bytes of a display and back: pure functions of one value.
#pragma once

#include "image/image_io.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace onde {

/// The sRGB transfer curve, IEC 61966-2-1, with its linear toe. 0 and 1 map to themselves; values
/// outside [0, 1] follow the same curve, mirrored below zero.
float srgb_from_linear(float linear);

/// The inverse of srgb_from_linear.
float linear_from_srgb(float encoded);

/// A sample of a texture's picture as a linear number: `srgb` says that codes are of colours.
float linear_sample(const TexelImage& image, size_t at, bool srgb);

/// Display transforms: from linear light, of which they take what is negative or NaN for 0, to
/// linear light in [0, 1].

/// A smooth shoulder for values above 1: a rational fit of the ACES reference curve, applied per
/// channel. 0.8 at 1, clipped at 1 beyond 7.2.
/// Source: K. Narkowicz, "ACES Filmic Tone Mapping Curve", 2016 (published as CC0).
float filmic(float linear);

/// True to hue and, below 0.8, to colour but for the 0.04 that a dielectric reflects; above, it
/// compresses and fades to white. Source: Khronos PBR Neutral Tone Mapper, 2024.
glm::vec3 neutral(glm::vec3 linear);

/// 16.5 stops in a sigmoid of the logarithm, between two matrices that let bright colours fade.
/// Source: T. Sobotka, AgX, 2022, its curve in the closed form of its generator.
glm::vec3 agx(glm::vec3 linear);

/// A picture of colours that are multiplied by alpha already, with that as its fourth channel.
Image with_alpha(const Image& colors, const Image& alpha);

/// Colours by themselves of a picture whose fourth channel is the alpha that they are multiplied
/// by; pictures of other channels stay as they are.
Image straight_alpha(Image image);

/// Interleaved bytes of `image`, as many channels as it has: exposed, tone mapped, clipped and sRGB
/// encoded; a fourth channel is alpha and only clipped. NaN gives 0.
std::vector<uint8_t> display_bytes(const Image& image, const Display& display);

} // namespace onde
