#include "engines_variant.h"

#include "core/error.h"

#include <fmt/ranges.h>

#include <algorithm>

namespace onde::bench {

std::vector<Variant> all_variants(const gpu::DeviceFacts& facts) {
    gpu::DeviceFacts cpu = facts;
    cpu.is_cpu = true;
    const auto shaped = [&](uint32_t width, gpu::Launch launch, bool packets) {
        gpu::DeviceSettings settings = gpu::default_settings(cpu);
        settings.width = width;
        settings.launch = launch;
        settings.primary_packets = packets;
        return settings;
    };
    using gpu::Launch;
    return {{"fused-16-packets", Engine::wavefront, shaped(16, Launch::fused, true)},
            {"fused-16", Engine::wavefront, shaped(16, Launch::fused, false)},
            {"fused-8-packets", Engine::wavefront, shaped(8, Launch::fused, true)},
            {"fused-8", Engine::wavefront, shaped(8, Launch::fused, false)},
            {"fused-1", Engine::wavefront, shaped(1, Launch::fused, false)},
            {"staged-16", Engine::wavefront, shaped(16, Launch::staged, true)},
            {"staged-1-global", Engine::wavefront, gpu::DeviceSettings{}}, // what GPUs get
            {"megakernel-16", Engine::megakernel, shaped(16, Launch::fused, true)},
            {"megakernel-1", Engine::megakernel, shaped(1, Launch::fused, false)}};
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
