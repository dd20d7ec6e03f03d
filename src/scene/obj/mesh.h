// The mesh of an OBJ file.
#pragma once

#include "scene/mesh_parts.h"
#include "scene/obj/file.h"

namespace onde::obj {

/// One mesh of all faces, triangulated; corners that are equal share a vertex. `materials` has the
/// scene's material for each of File::material_names. Numbers have been repaired (repair.h).
JoinedMesh build_mesh(const File& file, const std::string& name,
                      std::span<const uint32_t> materials, Notes& notes, GradualSpending& cost);

} // namespace onde::obj
