// Who builds trees: Onde's builders and Embree's build qualities.
#pragma once

#include "model.h"

#include <functional>
#include <optional>

namespace onde::bench {

/// What a tree cost and what it is worth.
struct BuiltTree {
    double seconds = 0;
    uint64_t bytes = 0, peak_bytes = 0; ///< of the tree; at most while it was built
    std::optional<double> sah_cost;     ///< in units of BvhOptions; Embree doesn't tell
};

enum class Measure { speed, memory };

struct Builder {
    std::string name;
    uint64_t most_triangles; ///< of a model for which this builder makes sense
    /// Builds once and throws the tree away. Onde's peak is there only when memory is measured,
    /// which slows it down.
    std::function<BuiltTree(const Model&, Measure)> build;
};

std::vector<Builder> all_builders();

} // namespace onde::bench
