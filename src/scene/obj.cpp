// Wavefront OBJ and MTL: parsed by tinyobjloader, checked, triangulated and welded here.
#include "core/error.h"
#include "core/files.h"
#include "scene/loaders.h"
#include "scene/mesh_parts.h"
#include "scene/obj_material.h"
#include "scene/references.h"
#include "scene/triangulate.h"

#include <tiny_obj_loader.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>
#include <string_view>
#include <unordered_map>

namespace onde {
namespace fs = std::filesystem;

namespace {

/// What the file says, as tinyobjloader returns it.
struct ObjFile {
    fs::path path, folder;
    tinyobj::attrib_t attributes;
    std::vector<tinyobj::shape_t> shapes;
    std::vector<tinyobj::material_t> materials;
    Notes notes;
};

/// tinyobjloader reads "nan" and other words as 0; we refuse them with their line.
void check_numbers(const std::string& name, std::string_view text) {
    size_t line_number = 0;
    while (!text.empty()) {
        ++line_number;
        const size_t end = std::min(text.find('\n'), text.size());
        std::string_view line = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        line.remove_prefix(std::min(line.find_first_not_of(" \t"), line.size()));
        const size_t keyword_end = std::min(line.find_first_of(" \t"), line.size());
        const std::string_view keyword = line.substr(0, keyword_end);
        if (keyword != "v" && keyword != "vn" && keyword != "vt") continue;
        const std::string_view numbers = line.substr(keyword_end, line.find('#') - keyword_end);
        if (numbers.find_first_not_of("0123456789+-.eE \t\r") != std::string_view::npos)
            throw InputError("{}:{}: '{}' is followed by something that is not a finite number; "
                             "correct it",
                             name, line_number, keyword);
    }
}

/// Reads MTL files from the OBJ's folder only. One that is missing is a note.
class FolderMaterials : public tinyobj::MaterialReader {
  public:
    explicit FolderMaterials(ObjFile& file) : file_(file) {}

    bool operator()(const std::string& name, std::vector<tinyobj::material_t>* materials,
                    std::map<std::string, int>* index, std::string*, std::string*) override {
        std::string reference = name;
        std::replace(reference.begin(), reference.end(), '\\', '/');
        const fs::path path = resolve_inside(file_.folder, reference, file_.path.string());
        if (!fs::is_regular_file(path)) {
            file_.notes.add("A material library is missing", name);
            return false;
        }
        std::istringstream stream(read_file(path));
        std::string warning, error;
        tinyobj::LoadMtl(index, materials, &stream, &warning, &error);
        return true;
    }

  private:
    ObjFile& file_;
};

/// Materials that faces name but no MTL file has: tinyobjloader warns of each use in a line,
/// "material [ 'NAME' ] not found in .mtl".
void note_missing_materials(const std::string& warning, Notes& notes) {
    constexpr std::string_view BEFORE = "material [ '", AFTER = "' ] not found in .mtl";
    std::set<std::string> names;
    std::istringstream lines(warning);
    for (std::string line; std::getline(lines, line);)
        if (line.starts_with(BEFORE) && line.ends_with(AFTER))
            names.insert(line.substr(BEFORE.size(), line.size() - BEFORE.size() - AFTER.size()));
    for (const std::string& name : names)
        notes.add("Materials that no MTL file has are diffuse grey", name);
}

ObjFile parse(const fs::path& path) {
    ObjFile file;
    file.path = path;
    file.folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::string text = read_file(path);
    if (text.find('\0') != std::string::npos)
        throw InputError("{}: not a text file; an OBJ must be ASCII or UTF-8", path.string());
    check_numbers(path.string(), text);
    std::istringstream stream(std::move(text));
    FolderMaterials reader(file);
    std::string warning, error;
    if (!tinyobj::LoadObj(&file.attributes, &file.shapes, &file.materials, &warning, &error,
                          &stream, &reader, /*triangulate=*/false)) {
        std::replace(error.begin(), error.end(), '\n', ' ');
        throw InputError("{}: not a valid OBJ: {}; export it again", path.string(), error);
    }
    note_missing_materials(warning, file.notes);
    return file;
}

struct CornerHash {
    size_t operator()(const tinyobj::index_t& i) const {
        const uint64_t x = uint64_t(uint32_t(i.vertex_index)) * 0x9e3779b97f4a7c15u ^
                           uint64_t(uint32_t(i.texcoord_index)) * 0xc2b2ae3d27d4eb4fu ^
                           uint64_t(uint32_t(i.normal_index)) * 0x165667b19e3779f9u;
        return size_t(x ^ (x >> 29));
    }
};

struct CornerEqual {
    bool operator()(const tinyobj::index_t& a, const tinyobj::index_t& b) const {
        return a.vertex_index == b.vertex_index && a.texcoord_index == b.texcoord_index &&
               a.normal_index == b.normal_index;
    }
};

/// Triangles whose corners all have normals, or none; equal corners share a vertex.
class PartBuilder {
  public:
    PartBuilder(const ObjFile& file, bool normals) : file_(file), normals_(normals) {}

    void add_face(std::span<const tinyobj::index_t> corners, uint32_t material) {
        std::vector<uint32_t> vertices;
        std::vector<glm::vec3> positions;
        for (const tinyobj::index_t& corner : corners) {
            vertices.push_back(vertex(corner));
            positions.push_back(part_.positions[vertices.back()]);
        }
        for (const auto& [a, b, c] : triangulate(positions)) {
            part_.triangles.push_back(glm::uvec3(vertices[a], vertices[b], vertices[c]));
            part_.materials.push_back(material);
        }
    }

    MeshPart take() { return std::move(part_); }

  private:
    uint32_t vertex(const tinyobj::index_t& corner);
    const float* element(const std::vector<float>& values, int index, size_t size,
                         const char* kind) const;

    const ObjFile& file_;
    bool normals_;
    MeshPart part_;
    std::unordered_map<tinyobj::index_t, uint32_t, CornerHash, CornerEqual> vertices_;
};

const float* PartBuilder::element(const std::vector<float>& values, int index, size_t size,
                                  const char* kind) const {
    const size_t count = values.size() / size;
    if (index < 0 || size_t(index) >= count)
        throw InputError("{}: a face names {} {}, but there are {}; export it again",
                         file_.path.string(), kind, int64_t(index) + 1, count);
    const float* element = &values[size_t(index) * size];
    if (!std::all_of(element, element + size, [](float x) { return std::isfinite(x); }))
        throw InputError("{}: {} {} is not finite; export it again", file_.path.string(), kind,
                         int64_t(index) + 1);
    return element;
}

uint32_t PartBuilder::vertex(const tinyobj::index_t& corner) {
    tinyobj::index_t key = corner;
    if (!normals_) key.normal_index = -1;
    const auto [found, is_new] = vertices_.try_emplace(key, uint32_t(part_.positions.size()));
    if (!is_new) return found->second;
    if (part_.positions.size() >= MAX_VERTICES)
        throw InputError("{}: more than {} vertices; split the file", file_.path.string(),
                         MAX_VERTICES);
    const float* p = element(file_.attributes.vertices, key.vertex_index, 3, "vertex");
    part_.positions.emplace_back(p[0], p[1], p[2]);
    if (normals_) {
        const float* n = element(file_.attributes.normals, key.normal_index, 3, "normal");
        part_.normals.emplace_back(n[0], n[1], n[2]);
    }
    glm::vec2 uv(0.0f);
    if (key.texcoord_index != -1) {
        const float* t =
            element(file_.attributes.texcoords, key.texcoord_index, 2, "texture vertex");
        uv = glm::vec2(t[0], 1.0f - t[1]);
    }
    part_.uvs.push_back(uv);
    return found->second;
}

void add_shape(ObjFile& file, const tinyobj::mesh_t& mesh, uint32_t default_material,
               PartBuilder& smooth, PartBuilder& flat) {
    size_t first = 0;
    for (size_t face = 0; face < mesh.num_face_vertices.size(); ++face) {
        const size_t count = mesh.num_face_vertices[face];
        const std::span<const tinyobj::index_t> corners(&mesh.indices[first], count);
        first += count;
        const int named = mesh.material_ids[face];
        const bool known = named >= 0 && size_t(named) < file.materials.size();
        const bool normals = std::all_of(corners.begin(), corners.end(), [](const auto& corner) {
            return corner.normal_index != -1;
        });
        (normals ? smooth : flat).add_face(corners, known ? uint32_t(named) : default_material);
    }
}

/// Debian's tinyobjloader counts a face's corners in 8 bits.
void check_face_sizes(const ObjFile& file, const tinyobj::shape_t& shape) {
    size_t corners = 0;
    for (const auto count : shape.mesh.num_face_vertices) corners += count;
    if (corners != shape.mesh.indices.size() ||
        shape.mesh.material_ids.size() != shape.mesh.num_face_vertices.size())
        throw InputError("{}: '{}' has a face of more than 255 corners; triangulate it",
                         file.path.string(), shape.name);
}

Mesh build_mesh(ObjFile& file, uint32_t default_material) {
    PartBuilder smooth(file, true), flat(file, false);
    for (const tinyobj::shape_t& shape : file.shapes) {
        check_face_sizes(file, shape);
        add_shape(file, shape.mesh, default_material, smooth, flat);
        if (!shape.lines.indices.empty() || !shape.points.indices.empty())
            file.notes.add("Points and lines are skipped", shape.name);
    }
    std::vector<MeshPart> parts{smooth.take(), flat.take()};
    const auto empty = [](const MeshPart& part) { return part.triangles.empty(); };
    parts.erase(std::remove_if(parts.begin(), parts.end(), empty), parts.end());
    if (file.attributes.texcoords.empty())
        for (MeshPart& part : parts) part.uvs.clear();
    return join_parts(file.path.stem().string(), std::move(parts), file.notes);
}

} // namespace

Scene load_obj(const fs::path& path) {
    ObjFile file = parse(path);
    Scene scene;
    for (const tinyobj::material_t& material : file.materials)
        scene.materials.push_back(
            convert_mtl(material, scene, file.folder, path.string(), file.notes));
    scene.materials.emplace_back().name = "default";
    scene.meshes.push_back(build_mesh(file, uint32_t(scene.materials.size() - 1)));
    scene.instances.push_back({0, glm::mat4(1.0f)});
    scene.notes = file.notes.sentences();
    return scene;
}

} // namespace onde
