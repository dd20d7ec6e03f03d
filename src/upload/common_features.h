// Kinds of scenes that are common enough to compile kernels for before there is a scene.
#pragma once

#include "upload/pack.h"

namespace onde {

struct CommonFeatures {
    const char* name; ///< for people
    SceneFeatures features;
    bool beyond_cache = false; ///< the tree is larger than the device's cache
};

/// A program is compiled for exactly a scene's features; these are sets that many scenes have. The
/// layout is left at its default.
std::vector<CommonFeatures> common_features();

/// All that a model in a file of other formats than our own may ask of kernels, but for what
/// vertices carry in memory.
SceneFeatures model_features();

} // namespace onde
