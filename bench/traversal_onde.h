// Onde as a contender: the trees that take part, from one builder.
#pragma once

#include "traversal_rays.h"

#include <optional>

namespace onde::bench {

struct OndeTracers {
    RayQuery wide, portable, watertight, compressed, binary;
    std::optional<RayQuery> against; ///< the wide tree walked by other kernels

    OndeTracers(const gpu::Device& device, const gpu::KernelSources& sources,
                const gpu::KernelSources* others, const Geometry& geometry, BvhBuilder builder)
        : wide(device, sources, nullptr, geometry, {.builder = builder}),
          portable(device, sources, nullptr, geometry, {.builder = builder},
                   {"ONDE_AVX512=0", "ONDE_AVX2=0"}),
          watertight(device, sources, nullptr, geometry, {.builder = builder, .watertight = true}),
          compressed(device, sources, nullptr, geometry,
                     {.builder = builder, .layout = BvhLayout::compressed}),
          binary(device, sources, nullptr, geometry,
                 {.builder = builder, .layout = BvhLayout::binary}) {
        if (others)
            against.emplace(device, *others, nullptr, geometry, BvhOptions{.builder = builder});
    }
};

} // namespace onde::bench
