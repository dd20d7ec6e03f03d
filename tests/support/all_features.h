// Kernels for all scenes of a test.
#pragma once

#include "upload/features.h"

namespace onde::test {

/// Kernels that can do everything but what scenes seldom need, so that all scenes of a test share
/// one compiled program.
inline SceneFeatures all_features() {
    return with_all_materials({.instances = true,
                               .spheres = true,
                               .shapes = true,
                               .curved = true,
                               .textures = true,
                               .normal_maps = true,
                               .environment = true,
                               .kinds = ALL_KINDS,
                               .lights = ALL_LIGHTS,
                               .stack_size = 192});
}

} // namespace onde::test
