// Meshes of glTF (section 3.7): the primitives of a mesh become one Mesh.
#include "core/error.h"
#include "core/shown.h"
#include "scene/gltf/choice.h"
#include "scene/gltf/draco.h"
#include "scene/gltf/reachable.h"
#include "scene/gltf/scene.h"
#include "scene/mesh_parts.h"
#include "scene/part_repair.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>
#include <set>

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

/// The sets of texture coordinates after the first that some texture uses.
void read_further_uvs(File& file, const Primitive& primitive, const std::set<uint32_t>& sets,
                      const std::string& user, MeshPart& part) {
    for (const uint32_t set : sets) {
        const std::string name = fmt::format("TEXCOORD_{}", set);
        const Index uvs = attribute(primitive, name.c_str());
        if (set == 0 || !uvs) continue;
        const std::string what = fmt::format("{} {}", user, name);
        part.more_uvs.resize(std::max<size_t>(part.more_uvs.size(), set));
        part.more_uvs[set - 1] = read_vec2(file, *uvs, what);
        check_count(file, what, part.more_uvs[set - 1].size(), part.positions.size());
    }
}

void read_colors(File& file, const Primitive& primitive, const std::string& user, MeshPart& part) {
    const Index accessor = attribute(primitive, "COLOR_0");
    if (!accessor) return;
    part.colors = read_color(file, *accessor, user + " COLOR_0");
    check_count(file, user + " COLOR_0", part.colors.size(), part.positions.size());
    for (glm::vec4& color : part.colors)
        if (!std::isfinite(color.r + color.g + color.b + color.a)) {
            color = glm::vec4(1.0f);
            file.notes.wrong("Vertex colours that are no numbers are white", user);
        }
}

/// Those that are no unit vectors with a sign are left to be computed.
void read_tangents(File& file, const Primitive& primitive, const std::string& user,
                   MeshPart& part) {
    const Index accessor = attribute(primitive, "TANGENT");
    if (!accessor) return;
    part.tangents = read_any_vec4(file, *accessor, user + " TANGENT");
    check_count(file, user + " TANGENT", part.tangents.size(), part.positions.size());
    for (glm::vec4& tangent : part.tangents) {
        const float length = glm::length(glm::vec3(tangent));
        if (std::abs(length - 1.0f) < 0.1f && std::abs(tangent.w) == 1.0f) {
            tangent = glm::vec4(glm::vec3(tangent) / length, tangent.w);
            continue;
        }
        tangent = glm::vec4(0.0f);
        file.notes.wrong("Tangents that are no unit vectors are computed", user);
    }
}

MeshPart convert(File& file, const Primitive& primitive, uint32_t default_material,
                 const std::set<uint32_t>& uv_sets, const Pose& pose, const std::string& user) {
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
    read_further_uvs(file, primitive, uv_sets, user, part);
    read_colors(file, primitive, user, part);
    read_tangents(file, primitive, user, part);
    pose_part(file, primitive, pose, user, part);
    if (!pose.weights.empty() || !pose.joints.empty()) part.tangents.clear();
    part.triangles = assemble(vertex_order(file, primitive, vertices, user), primitive.mode);
    uint32_t material = default_material;
    if (primitive.material) {
        at(file, file.document.materials, *primitive.material, "material", user);
        material = *primitive.material;
    }
    part.materials.assign(part.triangles.size(), material);
    repair_part(part, user, file.notes);
    return part;
}

std::string text_of(const Attributes& attributes) {
    std::string text = "{";
    for (const auto& [name, accessor] : attributes) text += fmt::format("{}:{} ", name, accessor);
    return text + "}";
}

/// A text that is the same for meshes that are built from the same data in the same way.
std::string text_of(const MeshSource& mesh, Index variant, const std::vector<double>& weights,
                    Index skin) {
    const auto number = [](Index index) { return index ? int64_t(*index) : -1; };
    std::string text = fmt::format("skin {}", number(skin));
    for (double weight : weights) text += fmt::format(" {}", weight);
    for (const Primitive& primitive : mesh.primitives) {
        text += fmt::format(" mode {} indices {} material {} {}", primitive.mode,
                            number(primitive.indices), number(material_of(primitive, variant)),
                            text_of(primitive.attributes));
        for (const Attributes& target : primitive.targets) text += text_of(target);
        if (primitive.draco)
            text += fmt::format(" draco {} {}", primitive.draco->view,
                                text_of(primitive.draco->attributes));
    }
    return text;
}

} // namespace

MeshLoader::MeshLoader(File& file, Scene& scene) : file_(file), scene_(scene) {
    const std::vector<std::string>& variants = file.document.variants;
    variant_ = chosen_variant(file);
    if (!variant_ && !variants.empty())
        file.notes.add("Material variants are there; --variant chooses one", names_of(variants));
}

Index MeshLoader::load(uint32_t mesh, const Pose& pose, Index skin, const std::string& user) {
    const MeshSource& source = at(file_, file_.document.meshes, mesh, "mesh", user);
    const std::vector<double>& weights = pose.weights.empty() ? source.weights : pose.weights;
    const auto [found, is_new] = loaded_.try_emplace({mesh, weights, skin}, std::nullopt);
    if (!is_new) return found->second;
    const auto [same, is_first] =
        equal_.try_emplace(text_of(source, variant_, weights, skin), std::nullopt);
    if (is_first) same->second = build(source, mesh, {weights, pose.joints});
    return found->second = same->second;
}

Index MeshLoader::build(const MeshSource& source, uint32_t mesh, const Pose& pose) {
    const uint32_t default_material = uint32_t(file_.document.materials.size());
    std::set<uint32_t> uv_sets;
    for (const Texture& texture : scene_.textures) uv_sets.insert(texture.uv_set);
    std::vector<MeshPart> parts;
    for (size_t p = 0; p < source.primitives.size(); ++p) {
        const std::string user = fmt::format("mesh {} primitive {}", mesh, p);
        Primitive primitive = source.primitives[p];
        if (primitive.mode < TRIANGLES) {
            file_.notes.add("Points and lines are skipped", user);
            continue;
        }
        if (!attribute(primitive, "POSITION")) {
            file_.notes.wrong("Primitives without POSITION are skipped", user);
            continue;
        }
        primitive.material = material_of(primitive, variant_);
        parts.push_back(convert(file_, primitive, default_material, uv_sets, pose, user));
        vertices_ += parts.back().positions.size() + parts.back().triangles.size();
        if (vertices_ > MAX_VERTICES)
            throw InputError("{}: more than {} vertices and triangles; split the scene", file_.name,
                             MAX_VERTICES);
    }
    const std::string name = source.name.empty() ? fmt::format("mesh {}", mesh) : source.name;
    JoinedMesh joined = join_parts(shown(name), std::move(parts), file_.notes);
    if (joined.mesh.triangles.empty()) return std::nullopt;
    scene_.meshes.push_back(std::move(joined.mesh));
    origins_.push_back(joined.origin);
    return uint32_t(scene_.meshes.size() - 1);
}

} // namespace onde::gltf
