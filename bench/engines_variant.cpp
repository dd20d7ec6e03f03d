#include "engines_variant.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace onde::bench {

namespace {

/// The least paths of a work item that compacts its own chunk.
constexpr uint32_t LEAST_CHUNK = 16;

/// The device's own waves, groups and chunks, of other lanes and launches.
gpu::DeviceSettings shaped(const gpu::DeviceFacts& facts, uint32_t width, gpu::Launch launch) {
    gpu::DeviceSettings settings = gpu::default_settings(facts);
    settings.width = width;
    settings.launch = launch;
    settings.chunk = std::max(settings.chunk, LEAST_CHUNK);
    return settings;
}

/// As GPUs get it, on any device.
gpu::DeviceSettings like_a_gpu(const gpu::DeviceFacts& facts) {
    gpu::DeviceFacts gpu = facts;
    gpu.is_cpu = false;
    return gpu::default_settings(gpu);
}

} // namespace

std::vector<Variant> all_variants(const gpu::DeviceFacts& facts) {
    const auto shaped = [&](uint32_t width, gpu::Launch launch) {
        return bench::shaped(facts, width, launch);
    };
    using gpu::Launch;
    return {{"fused-16", Engine::wavefront, shaped(16, Launch::fused)},
            {"fused-8", Engine::wavefront, shaped(8, Launch::fused)},
            {"fused-1", Engine::wavefront, shaped(1, Launch::fused)},
            {"staged-16", Engine::wavefront, shaped(16, Launch::staged)},
            {"staged-1", Engine::wavefront, like_a_gpu(facts)},
            {"megakernel-16", Engine::megakernel, shaped(16, Launch::fused)},
            {"megakernel-1", Engine::megakernel, shaped(1, Launch::fused)}};
}

std::vector<Variant> choose_variants(const gpu::DeviceFacts& facts,
                                     std::span<const std::string> names) {
    std::vector<Variant> variants = all_variants(facts);
    std::vector<std::string> known;
    for (const Variant& variant : variants) known.push_back(variant.name);
    for (const std::string& name : names)
        if (std::ranges::find(known, name) == known.end())
            throw InputError("--variants {}: no such variant; use {}", name,
                             fmt::join(known, ", "));
    if (!names.empty())
        std::erase_if(variants, [&](const Variant& variant) {
            return std::ranges::find(names, variant.name) == names.end();
        });
    return variants;
}

} // namespace onde::bench
