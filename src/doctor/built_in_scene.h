// The scene that comes with the program: small, with something of everything, for checks of whole
// pictures.
#pragma once

#include "scene/scene.h"

namespace onde::doctor {

/// A room that is open above, with a textured and normal-mapped floor, instances of a curved mesh,
/// a ball of glass, a metal torus, and lights of every type. Complete (see complete_scene).
Scene built_in_scene();

} // namespace onde::doctor
