// The elements and properties of PLY files that Onde knows by name: the one list.
#pragma once

#include "scene/file_words.h"
#include "scene/ply/header.h"

namespace onde::ply {

inline constexpr std::string_view VERTEX = "vertex", FACE = "face", STRIPS = "tristrips";

/// The numbers of a vertex that we use.
enum Slot { X, Y, Z, NX, NY, NZ, U, V, R, G, B, A, UNUSED };

Slot slot_of(const Property& property);

/// Of a face or of strips: the list of its vertices.
bool is_corner_list(const Property& property);

/// MeshLab's: u and v of each corner of a face.
bool is_corner_uvs(const Property& property);

} // namespace onde::ply
