#include "upload/geometry.h"

#include "upload/emissive.h"
#include "upload/octahedral.h"
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

bool emits(const Material& material) {
    return material.emission.x > 0 || material.emission.y > 0 || material.emission.z > 0;
}

bool mesh_emits(const Scene& scene, const Mesh& mesh) {
    for (uint32_t material : mesh.materials)
        if (emits(scene.materials[material])) return true;
    return false;
}

/// How much of the uv map turns left, and where u grows: the tangent frame of a triangle.
uint32_t encode_tangent(const glm::vec3 corner[3], const glm::vec2 uv[3], glm::vec3 normal) {
    const glm::vec3 e1 = corner[1] - corner[0], e2 = corner[2] - corner[0];
    const glm::vec2 d1 = uv[1] - uv[0], d2 = uv[2] - uv[0];
    const float turn = d1.x * d2.y - d1.y * d2.x;
    const float sign = turn < 0 ? -1.0f : 1.0f;
    const glm::vec3 fallback = std::abs(normal.x) < 0.9f ? glm::vec3(1, 0, 0) : glm::vec3(0, 1, 0);
    const glm::vec3 tangent = unit_or((e1 * d2.y - e2 * d1.y) * sign, fallback);
    // v runs downward in the picture while +Y of a normal map is up, so that glTF's bitangent,
    // cross(n, t) * w, has w = -1 where the uv map keeps its orientation on the surface.
    const glm::vec3 grows_v = (e2 * d1.x - e1 * d2.x) * sign;
    const bool against = glm::dot(glm::cross(normal, tangent), -grows_v) < 0;
    return (encode_octahedral(tangent) & ~1u) | uint32_t(against);
}

/// Any of the textures may be, or become, some material's normal map.
bool needs_tangents(const Scene& scene) {
    return !scene.textures.empty();
}

/// Writes the primitives of one mesh, placed by `transform`, to a geometry's arrays.
class MeshWriter {
  public:
    MeshWriter(const Scene& scene, FlatGeometry& flat, std::vector<glm::vec3>& positions,
               std::vector<glm::uvec3>& triangles)
        : scene_(scene), flat_(flat), positions_(positions), triangles_(triangles),
          tangents_(needs_tangents(scene)) {}

    void add(const Mesh& mesh, const glm::mat4& transform) {
        const glm::mat3 linear(transform);
        normal_matrix_ = glm::transpose(glm::inverse(linear));
        orientation_ = glm::determinant(linear) < 0 ? -1.0f : 1.0f;
        first_ = uint32_t(positions_.size());
        first_vertex_ = uint32_t(flat_.vertices.size());
        for (glm::vec3 p : mesh.positions) positions_.push_back(point(transform, p));
        if (has_vertices(mesh))
            for (uint32_t i = 0; i < mesh.positions.size(); i++)
                flat_.vertices.push_back(vertex(mesh, i, glm::vec3(0, 0, 1)));
        for (size_t i = 0; i < mesh.triangles.size(); i++) {
            triangles_.push_back(mesh.triangles[i] + first_);
            add_surface(mesh, i);
        }
    }

  private:
    static bool has_vertices(const Mesh& mesh) {
        return !mesh.normals.empty() || !mesh.uvs.empty();
    }

    /// A vertex whose normal is `normal` where the mesh has no usable one.
    VertexRecord vertex(const Mesh& mesh, uint32_t i, glm::vec3 normal) const {
        VertexRecord record{};
        if (!mesh.normals.empty()) normal = unit_or(normal_matrix_ * mesh.normals[i], normal);
        record.normal = encode_octahedral(normal);
        if (!mesh.uvs.empty()) copy(record.uv, mesh.uvs[i]);
        return record;
    }

    /// The index of a corner's vertex: of its own where the mesh's has no usable normal.
    uint32_t corner_vertex(const Mesh& mesh, uint32_t corner, glm::vec3 geometric) {
        const VertexRecord own = vertex(mesh, corner, geometric);
        if (mesh.normals.empty() || own.normal == flat_.vertices[first_vertex_ + corner].normal)
            return first_vertex_ + corner;
        flat_.vertices.push_back(own);
        return uint32_t(flat_.vertices.size() - 1);
    }

    void add_surface(const Mesh& mesh, size_t triangle) {
        const glm::uvec3 corners = mesh.triangles[triangle];
        glm::vec3 p[3];
        glm::vec2 uv[3]{};
        for (uint32_t k = 0; k < 3; k++) {
            p[k] = positions_[first_ + corners[k]];
            if (!mesh.uvs.empty()) uv[k] = mesh.uvs[corners[k]];
        }
        const glm::vec3 geometric =
            unit_or(glm::cross(p[1] - p[0], p[2] - p[0]) * orientation_, glm::vec3(0, 0, 1));
        const uint32_t material = mesh.materials[triangle];
        const auto primitive = uint32_t(flat_.surfaces.size());
        TriangleSurface surface{};
        surface.light = NO_INDEX;
        copy(surface.geometric, geometric);
        bool flat = true;
        if (has_vertices(mesh)) {
            const uint32_t normal = encode_octahedral(geometric);
            for (uint32_t k = 0; k < 3; k++) {
                surface.vertex[k] = corner_vertex(mesh, corners[k], geometric);
                flat &= mesh.normals.empty() || flat_.vertices[surface.vertex[k]].normal == normal;
            }
        }
        surface.tag = material | (flat ? SURFACE_FLAT : 0);
        if (tangents_) {
            flat_.tangents.resize(primitive);
            flat_.tangents.push_back(encode_tangent(p, uv, geometric));
        }
        if (emits(scene_.materials[material]))
            flat_.emissive.push_back(emissive_triangle(primitive, material, p, orientation_));
        flat_.surfaces.emplace_back().triangle = surface;
    }

    const Scene& scene_;
    FlatGeometry& flat_;
    std::vector<glm::vec3>& positions_;
    std::vector<glm::uvec3>& triangles_;
    bool tangents_; ///< are written
    // Of the mesh that is being added.
    glm::mat3 normal_matrix_{1.0f};
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
    if (needs_tangents(scene)) flat.tangents.resize(flat.surfaces.size());
    return flat;
}

} // namespace onde
