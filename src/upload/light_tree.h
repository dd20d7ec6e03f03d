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

/// What a branch says of its lights, its power aside; a negative radius is none.
struct BranchBounds {
    glm::dvec3 center, axis;
    double radius, cosine_of_spread, cosine_of_reach;
};
BranchBounds bounds_of(const LightBranch& branch);

/// The tree of the lights `local`, of the lights behind them that are everywhere, of which only the
/// power is known, and the trails of both; no branches where there are fewer than two lights in
/// all. Local lights are split by Conty Estevez and Kulla's surface area and orientation heuristic
/// (2018, section 4.1), into halves where the tree would become too deep. Those without power stay
/// outside of it. Deterministic.
LightTree build_light_tree(std::span<const LightBounds> local, std::span<const double> everywhere);

} // namespace onde
