// The light tree of shared/scene.h, by which one of many lights is chosen.
#pragma once

#include "upload/light_bounds.h"

#include <cstdint>
#include <span>
#include <vector>

namespace onde {

struct LightTree {
    std::vector<LightBranch> branches; ///< in pairs
    std::vector<uint32_t> trails;      ///< by light
};

/// The tree of the lights `local`, of the lights behind them that are everywhere, of which only the
/// power is known, and the trails of both; no branches where there are fewer than two lights in
/// all. Local lights are split by Conty Estevez and Kulla's surface area and orientation heuristic
/// (2018, section 4.1), into halves where the tree would become too deep. Deterministic.
LightTree build_light_tree(std::span<const LightBounds> local, std::span<const double> everywhere);

} // namespace onde
