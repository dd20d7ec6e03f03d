// The checks of one thing of a scene, for those who change it. check_scene() of scene/load.h runs
// them all.
#pragma once

#include "scene/scene.h"

namespace onde {

// Each throws InputError that names the thing by its list and index, or `i`.

void check_material(const Scene& scene, size_t i);
void check_camera(const Camera& camera, size_t i);
/// Affine, invertible and finite.
void check_transform(const glm::mat4& m, const char* list, size_t i);

} // namespace onde
