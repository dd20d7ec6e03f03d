// The ways in which an engine can be driven, all of which must make the same bits.
#pragma once

#include "render/options.h"

#include "image/image.h"

#include <fmt/format.h>

#include <string>

namespace onde::doctor {

struct Variant {
    const char* name;
    Engine engine;
    gpu::Launch launch;
    uint32_t width;
    bool interleaved = false;
};

/// Every width in the fused engine, one that is quick to compile in the others.
inline constexpr Variant VARIANTS[] = {
    {"fused, 16 lanes", Engine::wavefront, gpu::Launch::fused, 16},
    {"fused, 8 lanes", Engine::wavefront, gpu::Launch::fused, 8},
    {"fused, 8 lanes, interleaved", Engine::wavefront, gpu::Launch::fused, 8, true},
    {"fused, 1 lane", Engine::wavefront, gpu::Launch::fused, 1},
    {"staged, 8 lanes", Engine::wavefront, gpu::Launch::staged, 8},
    {"staged, 1 lane", Engine::wavefront, gpu::Launch::staged, 1},
    {"megakernel, 8 lanes", Engine::megakernel, gpu::Launch::fused, 8},
    {"megakernel, 1 lane", Engine::megakernel, gpu::Launch::fused, 1},
};

inline RenderOptions apply(RenderOptions options, const Variant& variant) {
    options.engine = variant.engine;
    options.settings.launch = variant.launch;
    options.settings.width = variant.width;
    options.settings.interleave_above = variant.interleaved ? 0 : UINT64_MAX;
    return options;
}

/// The first value that differs, in words; empty when none does.
inline std::string first_difference(const Image& a, const Image& b) {
    for (size_t i = 0; i < a.pixels.size(); i++)
        if (a.pixels[i] != b.pixels[i])
            return fmt::format("pixel {},{} channel {}: {} and {}", i / 3 % a.width,
                               i / 3 / a.width, i % 3, a.pixels[i], b.pixels[i]);
    return {};
}

} // namespace onde::doctor
