// Makes what an OBJ file says fit for building a mesh: bad numbers are left out, and normals that
// smoothing groups stand for are computed.
#pragma once

#include "scene/obj/file.h"

namespace onde::obj {

/// Afterwards every position, normal and uv that a corner names is finite as floats, and no such
/// normal is zero. Faces with a bad position are dropped, faces with a bad normal lose their
/// normals, corners with a bad uv lose it; each with a note.
void drop_bad_numbers(File& file, Notes& notes);

/// Gives the faces of smoothing groups that have no normals those of their groups: at each
/// position the sum of its faces' normals, weighted by their areas.
void smooth_groups(File& file);

/// uv * scale + offset.
struct UvMove {
    glm::dvec2 scale{1.0}, offset{0.0};

    bool operator==(const UvMove&) const = default;
};

/// Moves the texture coordinates of every face as its material (of File::material_names) says.
void move_uvs(File& file, std::span<const UvMove> moves);

} // namespace onde::obj
