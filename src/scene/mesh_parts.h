// Joins the parts of a mesh as files store them, each with or without normals, texture coordinates
// and colours, into one.
#pragma once

#include "scene/notes.h"
#include "scene/scene.h"

namespace onde {

/// As Mesh, but normals need not be unit. All indices are in range, all numbers finite.
struct MeshPart {
    glm::dvec3 origin{0.0}; ///< from which positions are counted
    std::vector<glm::vec3> positions;
    std::vector<glm::vec3> normals;               ///< per vertex or empty
    std::vector<glm::vec2> uvs;                   ///< per vertex or empty
    std::vector<std::vector<glm::vec2>> more_uvs; ///< from set 1, each per vertex or empty
    std::vector<glm::vec4> colors;                ///< per vertex or empty
    std::vector<glm::vec4> tangents;              ///< per vertex or empty
    std::vector<glm::uvec3> triangles;
    std::vector<uint32_t> materials; ///< one per triangle
};

/// The most vertices that a file may make; keeps a small hostile file from filling the memory.
inline constexpr size_t MAX_VERTICES = size_t(1) << 28;

/// About what a loader holds at its peak for a triangle, and for a vertex that others share.
inline constexpr uint64_t TRIANGLE_BYTES = 32, VERTEX_BYTES = 128;

/// The same for a polygon of that many corners, of which ears may have to be clipped.
constexpr uint64_t polygon_bytes(uint64_t corners) {
    return corners * (corners <= 4 ? TRIANGLE_BYTES : 160);
}

struct JoinedMesh {
    Mesh mesh;
    glm::dvec3 origin{0.0}; ///< from which its positions are counted
};

/// One mesh of all parts, counted from the first of their origins that is not 0. Where some parts
/// have normals, the others get one vertex per corner with the face's normal; missing texture
/// coordinates are 0, missing colours white. Tangents go with normals. Normals are made unit; zero
/// ones are replaced by a face's normal, with a note. Triangles without area are kept, with a note.
JoinedMesh join_parts(std::string name, std::vector<MeshPart> parts, Notes& notes);

/// Makes it the one mesh of a scene, placed where it is.
void place_only(JoinedMesh joined, Scene& scene);

} // namespace onde
