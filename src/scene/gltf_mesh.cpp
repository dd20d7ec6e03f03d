// Meshes of glTF (section 3.7): the primitives of a mesh become one Mesh.
#include "core/error.h"
#include "scene/gltf_draco.h"
#include "scene/gltf_scene.h"
#include "scene/mesh_parts.h"

#include <fmt/format.h>

#include <numeric>

namespace onde::gltf {

namespace {

/// Primitive modes (section 5.24.4); those below are points and lines.
constexpr uint32_t TRIANGLES = 4, TRIANGLE_STRIP = 5, TRIANGLE_FAN = 6;

Index attribute(const Primitive& primitive, const char* name) {
    const auto found = primitive.attributes.find(name);
    if (found == primitive.attributes.end()) return std::nullopt;
    return found->second;
}

/// Triangles of a list, strip or fan (section 3.7.2.1). Leftover vertices are dropped.
std::vector<glm::uvec3> assemble(const std::vector<uint32_t>& i, uint32_t mode) {
    std::vector<glm::uvec3> triangles;
    if (mode == TRIANGLE_STRIP) {
        for (size_t k = 2; k < i.size(); ++k)
            triangles.push_back(k % 2 == 0 ? glm::uvec3(i[k - 2], i[k - 1], i[k])
                                           : glm::uvec3(i[k - 2], i[k], i[k - 1]));
    } else if (mode == TRIANGLE_FAN) {
        for (size_t k = 2; k < i.size(); ++k) triangles.push_back(glm::uvec3(i[k - 1], i[k], i[0]));
    } else {
        for (size_t k = 2; k < i.size(); k += 3)
            triangles.push_back(glm::uvec3(i[k - 2], i[k - 1], i[k]));
    }
    return triangles;
}

void check_count(const File& file, const std::string& user, size_t count, size_t vertices) {
    if (count == 0 || count == vertices) return;
    throw InputError("{}: {}: it has {} elements for {} positions; export it again", file.name,
                     user, count, vertices);
}

std::vector<uint32_t> vertex_order(const File& file, const Primitive& primitive, size_t vertices,
                                   const std::string& user) {
    if (!primitive.indices) {
        std::vector<uint32_t> order(vertices);
        std::iota(order.begin(), order.end(), 0u);
        return order;
    }
    std::vector<uint32_t> order = read_indices(file, *primitive.indices, user + " indices");
    for (size_t i = 0; i < order.size(); ++i)
        if (order[i] >= vertices)
            throw InputError("{}: {} indices: index {} is {}, but there are {} positions; export "
                             "it again",
                             file.name, user, i, order[i], vertices);
    return order;
}

void note_ignored(File& file, const Primitive& primitive, const std::string& user) {
    if (attribute(primitive, "COLOR_0")) file.notes.add("Vertex colours are ignored", user);
    if (attribute(primitive, "TANGENT"))
        file.notes.add("Tangents are ignored: they follow from the texture coordinates", user);
    if (attribute(primitive, "TEXCOORD_1"))
        file.notes.add("A second set of texture coordinates is ignored", user);
    if (!primitive.targets.empty()) file.notes.add("Morph targets are ignored", user);
}

MeshPart convert(File& file, const Primitive& primitive, uint32_t default_material,
                 const std::string& user) {
    MeshPart part;
    decode_draco(file, primitive, user);
    part.positions = read_vec3(file, *attribute(primitive, "POSITION"), user + " POSITION");
    const size_t vertices = part.positions.size();
    if (const Index normals = attribute(primitive, "NORMAL"))
        part.normals = read_vec3(file, *normals, user + " NORMAL");
    if (const Index uvs = attribute(primitive, "TEXCOORD_0"))
        part.uvs = read_vec2(file, *uvs, user + " TEXCOORD_0");
    check_count(file, user + " NORMAL", part.normals.size(), vertices);
    check_count(file, user + " TEXCOORD_0", part.uvs.size(), vertices);
    part.triangles = assemble(vertex_order(file, primitive, vertices, user), primitive.mode);
    uint32_t material = default_material;
    if (primitive.material) {
        at(file, file.document.materials, *primitive.material, "material", user);
        material = *primitive.material;
    }
    part.materials.assign(part.triangles.size(), material);
    note_ignored(file, primitive, user);
    return part;
}

} // namespace

void add_meshes(File& file, Scene& scene) {
    const uint32_t default_material = uint32_t(scene.materials.size() - 1);
    size_t vertices = 0;
    for (size_t m = 0; m < file.document.meshes.size(); ++m) {
        const MeshSource& source = file.document.meshes[m];
        std::vector<MeshPart> parts;
        for (size_t p = 0; p < source.primitives.size(); ++p) {
            const std::string user = fmt::format("mesh {} primitive {}", m, p);
            if (source.primitives[p].mode < TRIANGLES) {
                file.notes.add("Points and lines are skipped", user);
                continue;
            }
            if (!attribute(source.primitives[p], "POSITION")) {
                file.notes.add("Primitives without POSITION are skipped", user);
                continue;
            }
            parts.push_back(convert(file, source.primitives[p], default_material, user));
            vertices += parts.back().positions.size() + parts.back().triangles.size();
            if (vertices > MAX_VERTICES)
                throw InputError("{}: more than {} vertices and triangles; split the scene",
                                 file.name, MAX_VERTICES);
        }
        const std::string name = source.name.empty() ? fmt::format("mesh {}", m) : source.name;
        scene.meshes.push_back(join_parts(name, std::move(parts), file.notes));
    }
}

} // namespace onde::gltf
