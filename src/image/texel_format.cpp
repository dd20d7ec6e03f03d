#include "image/texel_format.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace onde {
namespace {

constexpr float LEAST_NORMAL = 0x1p-14f, LEAST = 0x1p-24f, LARGEST = 65504.0f;

} // namespace

std::optional<uint16_t> exact_half(float x) {
    if (x < LEAST_NORMAL) return uint16_t(std::nearbyint(x / LEAST));
    const auto bits = std::bit_cast<uint32_t>(x);
    constexpr uint32_t CUT = 13, REBIAS = 127 - 15;
    if (x > LARGEST || bits % (1u << CUT) != 0) return std::nullopt;
    return uint16_t((bits >> CUT) - (REBIAS << 10));
}

float nearest_half(float x) {
    if (x >= LARGEST) return LARGEST;
    const float step = x < LEAST_NORMAL ? LEAST : std::ldexp(1.0f, std::ilogb(x) - 10);
    return std::nearbyint(x / step) * step;
}

TexelFormat texel_format(const TexelImage& image) {
    if (!image.is_linear()) return image.low.empty() ? TexelFormat::bytes : TexelFormat::wide;
    const bool fit =
        std::ranges::all_of(image.floats, [](float x) { return exact_half(x).has_value(); });
    return fit ? TexelFormat::halves : TexelFormat::floats;
}

uint32_t texel_words(const TexelImage& image) {
    switch (texel_format(image)) {
    case TexelFormat::bytes:
        return 1;
    case TexelFormat::wide:
    case TexelFormat::halves:
        return 2;
    case TexelFormat::floats:
        break;
    }
    return 4;
}

uint64_t device_bytes(const TexelImage& image) {
    return uint64_t(image.width) * image.height * texel_words(image) * sizeof(uint32_t);
}

} // namespace onde
