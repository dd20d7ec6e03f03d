#include "upload/geometry.h"

#include "upload/appearance.h"
#include "upload/emissive.h"
#include "upload/octahedral.h"
#include "upload/tangents.h"
#include "upload/words.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace onde {
namespace {

glm::vec3 point(const glm::mat4& m, glm::vec3 p) {
    return glm::vec3(m * glm::vec4(p, 1.0f));
}

glm::vec3 unit_or(glm::vec3 v, glm::vec3 fallback) {
    const float length = glm::length(v);
    return length > 0.0f && std::isfinite(length) ? v / length : fallback;
}

/// Where a triangle lies, see TriangleSurface.
struct TrianglePlane {
    glm::vec3 normal;
    float offset;
    uint32_t reach; // the exponent of the next power of two, as floats have it
};

uint32_t exponent_above(double length) {
    int exponent = 0;
    std::frexp(length, &exponent);
    return uint32_t(std::clamp(exponent + 127, 1, 254));
}

/// Corners and edges are rounded, and traversal computes the normal from the edges: of a narrow
/// triangle it is off by the edges' length over the triangle's height.
TrianglePlane triangle_plane(const glm::vec3 (&p)[3], float orientation) {
    constexpr double MOST_NARROW = 64.0; // narrower ones are hardly hit
    const glm::dvec3 a(p[0]), b(p[1]), c(p[2]);
    const glm::dvec3 across = glm::cross(b - a, c - a) * double(orientation);
    const double area2 = glm::length(across);
    TrianglePlane plane{glm::vec3(0, 0, 1), 0.0f, 0};
    if (area2 > 0.0 && std::isfinite(area2)) plane.normal = glm::vec3(across / area2);
    plane.offset = float(glm::dot(glm::dvec3(plane.normal), (a + b + c) / 3.0));
    const double edge = std::max({glm::length(b - a), glm::length(c - b), glm::length(a - c)});
    const double narrow = area2 > 0.0 ? std::min(edge * edge / area2, MOST_NARROW) : MOST_NARROW;
    const glm::vec3 far = glm::max(glm::max(glm::abs(p[0]), glm::abs(p[1])), glm::abs(p[2]));
    plane.reach = exponent_above(double(std::max({far.x, far.y, far.z})) + edge * narrow);
    return plane;
}

bool emits(const Material& material) {
    return material.emission.x > 0 || material.emission.y > 0 || material.emission.z > 0;
}

bool mesh_emits(const Scene& scene, const Mesh& mesh) {
    for (uint32_t material : mesh.materials)
        if (emits(scene.materials[material])) return true;
    return false;
}

/// What vertices have beside their records, where the scene needs it.
class VertexAttributes {
  public:
    VertexAttributes(const Scene& scene, FlatGeometry& flat)
        : flat_(flat), further_sets_(used_uv_sets(scene)), first_set_(further_sets_[0]) {
        further_sets_.erase(further_sets_.begin());
        for (const Mesh& mesh : scene.meshes) colors_ |= !mesh.colors.empty();
        for (const Material& m : scene.materials) tangents_ |= m.normal_texture != NO_TEXTURE;
    }

    bool tangents() const { return tangents_; }
    uint32_t first_set() const { return first_set_; }

    /// Appends those of vertex i of a mesh, or of none.
    void add(const Mesh* mesh, uint32_t i, uint32_t tangent) {
        for (const uint32_t set : further_sets_) {
            const bool has = mesh && !uv_set(*mesh, set).empty();
            const glm::vec2 uv = has ? uv_set(*mesh, set)[i] : glm::vec2(0.0f);
            flat_.uvs.insert(flat_.uvs.end(), {uv.x, uv.y});
        }
        if (colors_) {
            const bool has = mesh && !mesh->colors.empty();
            const glm::vec4 color = has ? mesh->colors[i] : glm::vec4(1.0f);
            const glm::vec4 scaled = glm::clamp(color, 0.0f, 1.0f) * 65535.0f + 0.5f;
            flat_.colors.push_back(uint32_t(scaled.x) | uint32_t(scaled.y) << 16);
            flat_.colors.push_back(uint32_t(scaled.z) | uint32_t(scaled.w) << 16);
        }
        if (tangents_) flat_.tangents.push_back(tangent);
    }

  private:
    FlatGeometry& flat_;
    std::vector<uint32_t> further_sets_;
    uint32_t first_set_;
    bool colors_ = false, tangents_ = false;
};

/// The direction, and in the lowest bit whether w is negative.
uint32_t encode_tangent(const glm::vec4& tangent) {
    return (encode_octahedral(glm::vec3(tangent)) & ~1u) | uint32_t(tangent.w < 0);
}

/// For each corner of a mesh's triangles that have normal maps, by the map's own coordinates; zero
/// for others, empty where there are none.
std::vector<glm::vec4> mesh_tangents(const Scene& scene, const Mesh& mesh) {
    std::vector<uint32_t> mapped; // triangles
    for (uint32_t t = 0; t < mesh.triangles.size(); t++)
        if (scene.materials[mesh.materials[t]].normal_texture != NO_TEXTURE) mapped.push_back(t);
    if (mapped.empty()) return {};
    std::vector<TangentCorner> corners;
    corners.reserve(3 * mapped.size());
    for (const uint32_t t : mapped) {
        const glm::uvec3 v = mesh.triangles[t];
        const auto& p = mesh.positions;
        const int32_t index = scene.materials[mesh.materials[t]].normal_texture;
        const Texture& texture = scene.textures[size_t(index)];
        const std::vector<glm::vec2>& uvs = uv_set(mesh, texture.uv_set);
        const glm::vec3 flat =
            unit_or(glm::cross(p[v.y] - p[v.x], p[v.z] - p[v.x]), glm::vec3(0, 0, 1));
        for (glm::length_t k = 0; k < 3; k++)
            corners.push_back({p[v[k]], mesh.normals.empty() ? flat : mesh.normals[v[k]],
                               texture.transform(uvs.empty() ? glm::vec2(0.0f) : uvs[v[k]])});
    }
    const std::vector<glm::vec4> computed = corner_tangents(corners);
    std::vector<glm::vec4> tangents(3 * mesh.triangles.size(), glm::vec4(0.0f));
    for (size_t i = 0; i < mapped.size(); i++)
        for (size_t k = 0; k < 3; k++) {
            const uint32_t vertex = mesh.triangles[mapped[i]][glm::length_t(k)];
            const bool own = !mesh.tangents.empty() && mesh.tangents[vertex].w != 0.0f;
            tangents[3 * mapped[i] + k] = own ? mesh.tangents[vertex] : computed[3 * i + k];
        }
    return tangents;
}

/// Writes the primitives of one mesh, placed by `transform`, to a geometry's arrays.
class MeshWriter {
  public:
    MeshWriter(const Scene& scene, FlatGeometry& flat, std::vector<glm::vec3>& positions,
               std::vector<glm::uvec3>& triangles)
        : scene_(scene), flat_(flat), positions_(positions), triangles_(triangles),
          attributes_(scene, flat) {}

    void add(const Mesh& mesh, const glm::mat4& transform) {
        linear_ = glm::mat3(transform);
        normal_matrix_ = glm::transpose(glm::inverse(linear_));
        orientation_ = glm::determinant(linear_) < 0 ? -1.0f : 1.0f;
        first_ = uint32_t(positions_.size());
        first_vertex_ = uint32_t(flat_.vertices.size());
        for (glm::vec3 p : mesh.positions) positions_.push_back(point(transform, p));
        tangents_.clear();
        others_.clear();
        if (attributes_.tangents()) tangents_ = mesh_tangents(scene_, mesh);
        if (has_vertices(mesh))
            for (uint32_t i = 0; i < mesh.positions.size(); i++)
                add_vertex(mesh, i, vertex(mesh, i, glm::vec3(0, 0, 1)), NO_TANGENT);
        for (size_t i = 0; i < mesh.triangles.size(); i++) {
            triangles_.push_back(mesh.triangles[i] + first_);
            add_surface(mesh, i);
        }
    }

  private:
    static constexpr uint32_t NO_TANGENT = 0x80008000u; // what no direction is encoded as

    static bool has_vertices(const Mesh& mesh) {
        return !mesh.normals.empty() || !mesh.uvs.empty() || !mesh.more_uvs.empty() ||
               !mesh.colors.empty();
    }

    void add_vertex(const Mesh& mesh, uint32_t i, const VertexRecord& record, uint32_t tangent) {
        flat_.vertices.push_back(record);
        attributes_.add(&mesh, i, tangent);
    }

    /// A vertex whose normal is `normal` where the mesh has no usable one.
    VertexRecord vertex(const Mesh& mesh, uint32_t i, glm::vec3 normal) const {
        VertexRecord record{};
        if (!mesh.normals.empty()) normal = unit_or(normal_matrix_ * mesh.normals[i], normal);
        record.normal = encode_octahedral(normal);
        const std::vector<glm::vec2>& uvs = uv_set(mesh, attributes_.first_set());
        if (!uvs.empty()) copy(record.uv, uvs[i]);
        return record;
    }

    /// A corner's tangent in the space of the geometry.
    uint32_t corner_tangent(size_t corner) const {
        if (tangents_.empty() || tangents_[corner].w == 0.0f) return NO_TANGENT;
        const glm::vec3 placed = linear_ * glm::vec3(tangents_[corner]);
        return encode_tangent(
            {unit_or(placed, glm::vec3(1, 0, 0)), tangents_[corner].w * orientation_});
    }

    /// The index of a corner's vertex: of another one where the mesh's has no usable normal, or
    /// another tangent.
    uint32_t corner_vertex(const Mesh& mesh, uint32_t corner, glm::vec3 geometric,
                           uint32_t tangent) {
        const uint32_t usual = first_vertex_ + corner;
        const VertexRecord own = vertex(mesh, corner, geometric);
        const bool same = mesh.normals.empty() || own.normal == flat_.vertices[usual].normal;
        if (same && tangent != NO_TANGENT && flat_.tangents[usual] == NO_TANGENT)
            flat_.tangents[usual] = tangent;
        if (same && (tangent == NO_TANGENT || flat_.tangents[usual] == tangent)) return usual;
        const auto [other, is_new] = others_.try_emplace(std::tuple(corner, own.normal, tangent),
                                                         uint32_t(flat_.vertices.size()));
        if (is_new) add_vertex(mesh, corner, own, tangent);
        return other->second;
    }

    void add_surface(const Mesh& mesh, size_t triangle) {
        const glm::uvec3 corners = mesh.triangles[triangle];
        glm::vec3 p[3];
        for (uint32_t k = 0; k < 3; k++) p[k] = positions_[first_ + corners[k]];
        const TrianglePlane plane = triangle_plane(p, orientation_);
        const glm::vec3 geometric = plane.normal;
        const uint32_t material = mesh.materials[triangle];
        const auto primitive = uint32_t(flat_.surfaces.size());
        TriangleSurface surface{};
        surface.light = NO_INDEX;
        copy(surface.geometric, geometric);
        surface.plane = plane.offset;
        bool flat = true;
        if (has_vertices(mesh)) {
            const uint32_t normal = encode_octahedral(geometric);
            for (uint32_t k = 0; k < 3; k++) {
                const uint32_t tangent = corner_tangent(3 * triangle + k);
                surface.vertex[k] = corner_vertex(mesh, corners[k], geometric, tangent);
                flat &= mesh.normals.empty() || flat_.vertices[surface.vertex[k]].normal == normal;
            }
        }
        surface.tag = material | SURFACE_REACH(plane.reach) | (flat ? SURFACE_FLAT : 0);
        if (emits(scene_.materials[material]))
            flat_.emissive.push_back(emissive_triangle(primitive, material, p, orientation_));
        flat_.surfaces.emplace_back().triangle = surface;
    }

    const Scene& scene_;
    FlatGeometry& flat_;
    std::vector<glm::vec3>& positions_;
    std::vector<glm::uvec3>& triangles_;
    VertexAttributes attributes_;
    // Of the mesh that is being added.
    glm::mat3 linear_{1.0f}, normal_matrix_{1.0f};
    std::vector<glm::vec4> tangents_; ///< by corner of its triangles, or empty
    std::map<std::tuple<uint32_t, uint32_t, uint32_t>, uint32_t> others_; ///< see corner_vertex()
    float orientation_ = 1.0f;
    uint32_t first_ = 0, first_vertex_ = 0;
};

void add_sphere(const Scene& scene, FlatGeometry& flat, const Sphere& sphere) {
    const auto primitive = uint32_t(flat.surfaces.size());
    SphereSurface surface{};
    surface.tag = sphere.material | SURFACE_SPHERE;
    surface.light = NO_INDEX;
    copy(surface.center, sphere.center);
    surface.radius = sphere.radius;
    if (emits(scene.materials[sphere.material]))
        flat.emissive.push_back(emissive_sphere(primitive, sphere));
    flat.surfaces.emplace_back().sphere = surface;
    flat.spheres.push_back({sphere.center, sphere.radius});
}

/// Places shapes; equal ones that do not emit share a geometry.
class ShapeWriter {
  public:
    ShapeWriter(const Scene& scene, FlatGeometry& flat) : scene_(scene), flat_(flat) {}

    void add(const Shape& shape) {
        const bool light = emits(scene_.materials[shape.material]);
        const auto key = std::tuple(shape.kind, shape.minor_radius, shape.material);
        const auto known = geometry_of_.find(key);
        const bool shared = !light && known != geometry_of_.end();
        const uint32_t geometry = shared ? known->second : add_geometry(shape);
        if (light)
            flat_.emissive.push_back(emissive_shape(uint32_t(flat_.surfaces.size() - 1), shape));
        if (!light && !shared) geometry_of_.emplace(key, geometry);
        flat_.placements.push_back({geometry, shape.object_to_world});
    }

  private:
    uint32_t add_geometry(const Shape& shape) {
        static_assert(uint32_t(ShapeKind::sphere) == SHAPE_ELLIPSOID);
        static_assert(uint32_t(ShapeKind::disk) == SHAPE_DISK);
        static_assert(uint32_t(ShapeKind::cylinder) == SHAPE_CYLINDER);
        static_assert(uint32_t(ShapeKind::cone) == SHAPE_CONE);
        static_assert(uint32_t(ShapeKind::torus) == SHAPE_TORUS);
        ShapeSurface surface{};
        surface.tag = shape.material | SURFACE_SHAPE;
        surface.light = NO_INDEX;
        surface.shape = uint32_t(shape.kind);
        surface.minor_radius = shape.minor_radius;
        const ShapeInput& input =
            flat_.shapes.emplace_back(ShapeInput{uint32_t(shape.kind), shape.minor_radius});
        flat_.geometries.push_back(
            {{}, {}, {}, uint32_t(flat_.surfaces.size()), std::span(&input, 1)});
        flat_.surfaces.emplace_back().shape = surface;
        return uint32_t(flat_.geometries.size() - 1);
    }

    const Scene& scene_;
    FlatGeometry& flat_;
    std::map<std::tuple<ShapeKind, float, uint32_t>, uint32_t> geometry_of_;
};

std::vector<bool> meshes_to_instance(const Scene& scene) {
    std::vector<uint64_t> uses(scene.meshes.size());
    for (const Instance& instance : scene.instances) uses[instance.mesh]++;
    std::vector<bool> instanced(scene.meshes.size());
    for (size_t i = 0; i < uses.size(); i++) {
        const uint64_t copies = uses[i] * scene.meshes[i].triangles.size();
        instanced[i] = uses[i] > 1 && copies > BAKED_COPIES && !mesh_emits(scene, scene.meshes[i]);
    }
    return instanced;
}

} // namespace

FlatGeometry flatten_geometry(const Scene& scene) {
    FlatGeometry flat;
    flat.vertices.emplace_back();
    flat.uv_sets = used_uv_sets(scene);
    VertexAttributes(scene, flat).add(nullptr, 0, 0);
    const std::vector<bool> instanced = meshes_to_instance(scene);

    auto& positions = flat.positions.emplace_back();
    auto& triangles = flat.triangles.emplace_back();
    MeshWriter baked(scene, flat, positions, triangles);
    for (const Instance& instance : scene.instances)
        if (!instanced[instance.mesh])
            baked.add(scene.meshes[instance.mesh], instance.object_to_world);
    for (const Sphere& sphere : scene.spheres) add_sphere(scene, flat, sphere);
    flat.geometries.push_back({positions, triangles, flat.spheres, 0});
    flat.placements.push_back({0, glm::mat4(1.0f)});

    std::vector<uint32_t> geometry_of(scene.meshes.size());
    for (size_t i = 0; i < scene.meshes.size(); i++) {
        if (!instanced[i]) continue;
        const auto first_primitive = uint32_t(flat.surfaces.size());
        auto& own_positions = flat.positions.emplace_back();
        auto& own_triangles = flat.triangles.emplace_back();
        MeshWriter(scene, flat, own_positions, own_triangles).add(scene.meshes[i], glm::mat4(1.0f));
        geometry_of[i] = uint32_t(flat.geometries.size());
        flat.geometries.push_back({own_positions, own_triangles, {}, first_primitive});
    }
    for (const Instance& instance : scene.instances)
        if (instanced[instance.mesh])
            flat.placements.push_back({geometry_of[instance.mesh], instance.object_to_world});
    ShapeWriter shapes(scene, flat);
    for (const Shape& shape : scene.shapes) shapes.add(shape);
    return flat;
}

} // namespace onde
