// The ways of driving paths through a device that the bench compares, by name.
#pragma once

#include "render/options.h"

#include <span>
#include <string>
#include <vector>

namespace onde::bench {

struct Variant {
    std::string name;
    Engine engine = Engine::wavefront;
    gpu::DeviceSettings settings;
};

/// Every variant: "fused-16", "fused-8", ..., a CPU's default first. All but
/// "staged-1", which is what GPUs get, use the device's own waves and groups.
std::vector<Variant> all_variants(const gpu::DeviceFacts& facts);

/// Those with the given names, in the order of all_variants(); all of them when none is named.
/// Throws InputError with the list of names when there is no such variant.
std::vector<Variant> choose_variants(const gpu::DeviceFacts& facts,
                                     std::span<const std::string> names);

} // namespace onde::bench
