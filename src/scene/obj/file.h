// What an OBJ file says: its statements as arrays, with every index from 0. It knows nothing of
// materials' looks or of triangles.
#pragma once

#include "scene/load_context.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace onde::obj {

inline constexpr int32_t NONE = -1;

/// A corner of a face; uv and normal may be NONE.
struct Corner {
    int32_t position = NONE, uv = NONE, normal = NONE;

    bool operator==(const Corner&) const = default;
};

struct Face {
    size_t first = 0;       ///< of its corners; they end where the next face's begin
    uint32_t line = 0;      ///< where it stands
    uint32_t material = 0;  ///< index into material_names
    uint32_t smoothing = 0; ///< group within which normals are smooth; 0 is flat
};

struct File {
    std::vector<glm::dvec3> positions;       ///< may be NaN or infinite, as may the others
    std::vector<glm::vec3> colors;           ///< one a position, NaN where it has none; or empty
    std::vector<glm::dvec3> normals;         ///< of any length
    std::vector<glm::dvec2> uvs;             ///< v upward
    std::vector<Corner> corners;             ///< of all faces; indices are in range
    std::vector<Face> faces;                 ///< of three corners or more
    std::vector<std::string> material_names; ///< as usemtl writes them; the first is "", before any
    std::vector<std::string> libraries;      ///< what follows each mtllib

    std::span<const Corner> corners_of(size_t face) const {
        const size_t end = face + 1 < faces.size() ? faces[face + 1].first : corners.size();
        return std::span(corners).subspan(faces[face].first, end - faces[face].first);
    }
    std::span<Corner> corners_of(size_t face) {
        const auto constant = static_cast<const File&>(*this).corners_of(face);
        return {const_cast<Corner*>(constant.data()), constant.size()};
    }
};

/// Bytes that the arrays of a file hold.
uint64_t bytes_of(const File& file);

/// Reads the text of an OBJ file. What is left out is noted; an index that is no number or out of
/// range is an InputError "NAME:LINE: ...".
File read(const std::string& name, std::string_view text, Notes& notes, GradualSpending& cost);

} // namespace onde::obj
