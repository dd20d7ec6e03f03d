// What a loader does with numbers that are none.
#pragma once

#include "scene/mesh_parts.h"

namespace onde {

/// Leaves out the triangles that use a position that is not finite, and zeroes the positions,
/// normals and texture coordinates that are not; notes say so. A position that no triangle uses
/// has no note.
void repair_part(MeshPart& part, const std::string& user, Notes& notes);

} // namespace onde
