// Onde as a contender: the trees that take part, from one builder.
#pragma once

#include "traversal_rays.h"

#include <optional>

namespace onde::bench {

struct OndeTracers {
    RayQuery wide, portable, watertight, compressed, binary;
    std::optional<RayQuery> against; ///< the wide BVH, traversed by other kernels

    OndeTracers(gpu::Programs& programs, gpu::Programs* others, const Geometry& geometry,
                BvhBuilder builder)
        : wide(programs, geometry, {.builder = builder}, QueryKernels::every),
          portable(programs, geometry, {.builder = builder}, QueryKernels::every,
                   {"ONDE_AVX512=0", "ONDE_AVX2=0"}),
          watertight(programs, geometry, {.builder = builder, .watertight = true}),
          compressed(programs, geometry, {.builder = builder, .layout = BvhLayout::compressed}),
          binary(programs, geometry, {.builder = builder, .layout = BvhLayout::binary}) {
        if (others)
            against.emplace(*others, geometry, BvhOptions{.builder = builder}, QueryKernels::every);
    }
};

} // namespace onde::bench
