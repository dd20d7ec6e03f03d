// Scenes of any size: what is too large or too small for a float's squares and cubes is brought
// near to one, by powers of two, which lose no digit.
#pragma once

#include "scene/scene.h"

#include <optional>

namespace onde {

/// Sizes whose products stay in float's range.
inline constexpr float SMALLEST_SIZE = 1e-9f, LARGEST_SIZE = 1e9f;

/// Scales a scene whose coordinates lie beyond these sizes, so that its picture stays the same, and
/// adds a note. Meshes in their own spaces likewise, with their instances: no note, as nothing is
/// seen of it. Returns the exponent of two by which lengths were multiplied: `exponent`, where one
/// is given. The scene must satisfy check_scene(). Throws InputError when it is larger than floats
/// can say.
int bring_to_scale(Scene& scene, std::optional<int> exponent = {});

} // namespace onde
