// All contenders answer one ray set: their answers are compared first, then they take turns.
#pragma once

#include "figures.h"
#include "traversal_onde.h"

namespace onde::bench {

enum class Side { embree, onde, onde_watertight, against };

/// One contender on one ray set.
struct Timing {
    std::string contender;
    Side side = Side::embree;
    size_t mismatches = 0; ///< answers unlike the reference's
    Samples seconds{};
};

struct RaceOptions {
    uint32_t repetitions = 5;
    bool cpu_time = false; ///< processor time instead of wall-clock time
    /// "packet", "stream", "interleaved": who takes part beside the single rays; nobody named:
    /// everyone.
    std::vector<std::string> traversals{};
};

/// Times every mode of Embree's, and Onde's trees: the wide one by all traversals, with and without
/// machine instructions; the others ray by ray; and all traversals of other kernels, where there
/// are any. The reference is Embree's single ray: a hit differs when t does by more than 1e-4 of
/// it. `set` is not empty.
std::vector<Timing> race(const RaySet& set, const gpu::Device& device, const EmbreeScene& embree,
                         OndeTracers& onde, const RaceOptions& options);

} // namespace onde::bench
