#include "scene/mesh_parts.h"

#include "core/error.h"

#include <algorithm>

namespace onde {

/// The unit face normal, or zero for a triangle without area. In double precision, since the
/// squares of tiny edges underflow in float.
static glm::vec3 face_normal(const std::vector<glm::vec3>& positions, glm::uvec3 triangle) {
    const glm::dvec3 a(positions[triangle.x]), b(positions[triangle.y]), c(positions[triangle.z]);
    const glm::dvec3 normal = glm::cross(b - a, c - a);
    const double length = glm::length(normal);
    return length > 0.0 ? glm::vec3(normal / length) : glm::vec3(0.0f);
}

/// Calls visit(values of a, values of b) for each attribute of vertices but positions and normals.
template <class A, class B, class Visit>
static void for_each_attribute(A& a, B& b, const Visit& visit) {
    visit(a.uvs, b.uvs, glm::vec2(0.0f));
    for (size_t i = 0; i < a.more_uvs.size(); ++i)
        visit(a.more_uvs[i], b.more_uvs[i], glm::vec2(0.0f));
    visit(a.colors, b.colors, glm::vec4(1.0f));
    visit(a.tangents, b.tangents, glm::vec4(0.0f));
}

/// One vertex per corner, each with its face's normal.
static MeshPart flat_shaded(MeshPart& part) {
    MeshPart flat;
    flat.origin = part.origin;
    flat.materials = part.materials;
    flat.more_uvs.resize(part.more_uvs.size());
    for (const glm::uvec3& triangle : part.triangles) {
        const uint32_t first = uint32_t(flat.positions.size());
        const glm::vec3 normal = face_normal(part.positions, triangle);
        for (size_t corner = 0; corner < 3; ++corner) {
            flat.positions.push_back(part.positions[triangle[corner]]);
            flat.normals.push_back(normal);
            for_each_attribute(flat, part, [&](auto& to, const auto& from, const auto&) {
                if (!from.empty()) to.push_back(from[triangle[corner]]);
            });
        }
        flat.triangles.push_back(glm::uvec3(first, first + 1, first + 2));
    }
    return flat;
}

/// Most files have one part, which is not copied.
static void take_part(Mesh& mesh, MeshPart& part) {
    mesh.positions = std::move(part.positions);
    mesh.normals = std::move(part.normals);
    for_each_attribute(mesh, part, [](auto& to, auto& from, const auto&) { to = std::move(from); });
    mesh.triangles = std::move(part.triangles);
    mesh.materials = std::move(part.materials);
}

static void append_part(Mesh& mesh, const MeshPart& part) {
    const uint32_t first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), part.positions.begin(), part.positions.end());
    mesh.normals.insert(mesh.normals.end(), part.normals.begin(), part.normals.end());
    for_each_attribute(mesh, part, [](auto& to, const auto& from, const auto&) {
        to.insert(to.end(), from.begin(), from.end());
    });
    for (const glm::uvec3& triangle : part.triangles) mesh.triangles.push_back(triangle + first);
    mesh.materials.insert(mesh.materials.end(), part.materials.begin(), part.materials.end());
}

static void count_from(const glm::dvec3& origin, MeshPart& part) {
    if (part.origin == origin) return;
    const glm::dvec3 step = part.origin - origin;
    for (glm::vec3& position : part.positions) position = glm::vec3(glm::dvec3(position) + step);
    part.origin = origin;
}

static void make_normals_unit(Mesh& mesh, Notes& notes) {
    if (mesh.normals.empty()) return;
    bool repaired = false;
    for (const glm::uvec3& triangle : mesh.triangles)
        for (size_t corner = 0; corner < 3; ++corner) {
            glm::vec3& normal = mesh.normals[triangle[corner]];
            if (normal != glm::vec3(0.0f)) continue;
            normal = face_normal(mesh.positions, triangle);
            repaired = true;
        }
    for (glm::vec3& normal : mesh.normals) {
        const double length = glm::length(glm::dvec3(normal));
        normal = length > 0.0 ? glm::vec3(glm::dvec3(normal) / length) : glm::vec3(0, 1, 0);
    }
    if (repaired) notes.wrong("Normals of length zero are replaced by face normals", mesh.name);
}

static void note_degenerate(const Mesh& mesh, Notes& notes) {
    const auto degenerate = [&](const glm::uvec3& triangle) {
        return face_normal(mesh.positions, triangle) == glm::vec3(0.0f);
    };
    if (std::any_of(mesh.triangles.begin(), mesh.triangles.end(), degenerate))
        notes.add("Triangles without area can't be hit", mesh.name);
}

JoinedMesh join_parts(std::string name, std::vector<MeshPart> parts, Notes& notes) {
    const bool normals = std::any_of(parts.begin(), parts.end(),
                                     [](const MeshPart& part) { return !part.normals.empty(); });
    size_t sets = 0;
    for (const MeshPart& part : parts) sets = std::max(sets, part.more_uvs.size());
    MeshPart has; // an element in each attribute that some part has
    has.more_uvs.resize(sets);
    for (MeshPart& part : parts) {
        part.more_uvs.resize(sets);
        if (part.normals.empty()) part.tangents.clear();
        for_each_attribute(has, part, [](auto& any, const auto& values, const auto& absent) {
            if (!values.empty() && any.empty()) any.push_back(absent);
        });
    }
    JoinedMesh joined;
    for (const MeshPart& part : parts)
        if (joined.origin == glm::dvec3(0.0)) joined.origin = part.origin;
    Mesh& mesh = joined.mesh;
    mesh.name = std::move(name);
    mesh.more_uvs.resize(sets);
    for (MeshPart& part : parts) {
        count_from(joined.origin, part);
        if (normals && part.normals.empty()) part = flat_shaded(part);
        for_each_attribute(part, has, [&](auto& values, const auto& any, const auto& absent) {
            if (!any.empty() && values.empty()) values.resize(part.positions.size(), absent);
        });
        if (mesh.positions.size() + part.positions.size() > MAX_VERTICES)
            throw InputError("mesh '{}': more than {} vertices; split the scene", mesh.name,
                             MAX_VERTICES);
        if (mesh.positions.empty())
            take_part(mesh, part);
        else
            append_part(mesh, part);
        part = {};
    }
    note_degenerate(mesh, notes);
    make_normals_unit(mesh, notes);
    return joined;
}

void place_only(JoinedMesh joined, Scene& scene) {
    scene.origin = joined.origin;
    scene.meshes.push_back(std::move(joined.mesh));
    scene.instances.push_back({0, glm::mat4(1.0f)});
}

} // namespace onde
