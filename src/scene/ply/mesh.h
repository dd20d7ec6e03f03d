// The mesh of a PLY file: vertices with normals and texture coordinates, polygons, strips.
#pragma once

#include "scene/load_context.h"
#include "scene/mesh_parts.h"
#include "scene/ply/header.h"

namespace onde::ply {

/// Reads the values after the header of the file whose bytes these are, of material 0. What is
/// wrong costs its part and a note; what lies is an InputError, beginning with `name`.
JoinedMesh read_mesh(const std::string& name, const std::string& mesh_name, std::string_view file,
                     const Header& header, Notes& notes, LoadContext& context);

} // namespace onde::ply
