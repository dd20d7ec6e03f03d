// Choosing among many things by their weight, in constant time.
#pragma once

#include "shared/scene.h"

#include <span>
#include <vector>

namespace onde {

/// The alias table of non-negative finite weights (Vose 1991): draw i uniformly; stay at i when
/// the fraction left of the draw is below entry[i].below, else go to entry[i].alias. Entries hold
/// the resulting probabilities as `pmf`. All zero weights are taken as equal.
std::vector<AliasRecord> build_alias_table(std::span<const double> weights);

} // namespace onde
