// Choosing among many things by their weight, in constant time.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace onde {

struct AliasEntry {
    float below;    ///< the fraction of the draw below which it stays, else goes to `alias`
    uint32_t alias; ///< of the table
    float pmf;      ///< its own probability
};

/// The alias table of non-negative finite weights (Vose 1991): draw i uniformly; stay at i when
/// the fraction left of the draw is below entry[i].below, else go to entry[i].alias. All zero
/// weights are taken as equal.
std::vector<AliasEntry> build_alias_table(std::span<const double> weights);

} // namespace onde
