// Shapes of pbrt files that are meshes: their arrays checked, their fronts where pbrt has them.
#pragma once

#include "scene/mesh_parts.h"
#include "scene/pbrt/parameters.h"

namespace onde::pbrt {

/// The mesh that the parameters of a "trianglemesh", "bilinearmesh" or "loopsubdiv" state, of the
/// scene's material 0; of patches the corners, of subdivision surfaces the control mesh. Throws
/// InputError for indices of points that are none; what else is wrong costs its part and a note.
JoinedMesh mesh_of(const std::string& kind, const Parameters& parameters, Notes& notes);

/// Turns triangles so that their fronts are where pbrt has them: where the normals point, else as
/// their corners go around; the other way where `reversed`, normals too.
void turn_fronts(Mesh& mesh, bool reversed);

} // namespace onde::pbrt
