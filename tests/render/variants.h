// The ways in which an engine can be driven, all of which must make the same bits.
#pragma once

#include "render/options.h"

#include "image/image.h"

#include <fmt/format.h>

#include <string>

namespace onde::test {

struct Variant {
    const char* name;
    Engine engine;
    gpu::Launch launch;
    gpu::QueueKind queue;
    uint32_t width;
    bool packets;
    bool turns = false;
};

/// Every width in the fused engine, one that is quick to compile in the others.
inline constexpr Variant VARIANTS[] = {
    {"fused, 16 lanes, packets", Engine::wavefront, gpu::Launch::fused, gpu::QueueKind::chunk_local,
     16, true},
    {"fused, 8 lanes, packets", Engine::wavefront, gpu::Launch::fused, gpu::QueueKind::chunk_local,
     8, true},
    {"fused, 1 lane", Engine::wavefront, gpu::Launch::fused, gpu::QueueKind::chunk_local, 1, false},
    {"staged, 8 lanes, turns", Engine::wavefront, gpu::Launch::staged, gpu::QueueKind::chunk_local,
     8, false, true},
    {"staged, global queue, 8 lanes", Engine::wavefront, gpu::Launch::staged,
     gpu::QueueKind::global, 8, false},
    {"staged, global queue, 1 lane", Engine::wavefront, gpu::Launch::staged, gpu::QueueKind::global,
     1, false},
    {"megakernel, 8 lanes", Engine::megakernel, gpu::Launch::fused, gpu::QueueKind::chunk_local, 8,
     false},
    {"megakernel, 1 lane", Engine::megakernel, gpu::Launch::fused, gpu::QueueKind::chunk_local, 1,
     false},
};

inline RenderOptions apply(RenderOptions options, const Variant& variant) {
    options.engine = variant.engine;
    options.settings.launch = variant.launch;
    options.settings.queue = variant.queue;
    options.settings.width = variant.width;
    options.settings.primary_packets = variant.packets;
    options.settings.interleave_above = variant.turns ? 0 : UINT64_MAX;
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

} // namespace onde::test
