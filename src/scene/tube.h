// An open cylinder, which other renderers have and Onde's shapes lack.
#pragma once

#include "scene/scene.h"

namespace onde {

/// The side of a cylinder of radius 1 about the Z axis, z from 0 to 1, of smooth facets of the
/// scene's material 0. Its front is outside; u goes around, v along Z.
Mesh tube_mesh();

} // namespace onde
