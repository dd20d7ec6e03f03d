#include "upload/geometry.h"

#include "upload/octahedral.h"

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

/// Writes the primitives of one mesh, placed by `transform`, to a geometry's arrays.
class MeshWriter {
  public:
    MeshWriter(const Scene& scene, FlatGeometry& flat, std::vector<glm::vec3>& positions,
               std::vector<glm::uvec3>& triangles)
        : scene_(scene), flat_(flat), positions_(positions), triangles_(triangles) {}

    void add(const Mesh& mesh, const glm::mat4& transform) {
        const glm::mat3 linear(transform);
        const glm::mat3 normal_matrix = glm::transpose(glm::inverse(linear));
        const float orientation = glm::determinant(linear) < 0 ? -1.0f : 1.0f;
        const auto first = uint32_t(positions_.size());
        for (glm::vec3 p : mesh.positions) positions_.push_back(point(transform, p));
        for (size_t i = 0; i < mesh.triangles.size(); i++) {
            const glm::uvec3 corners = mesh.triangles[i];
            triangles_.push_back(corners + first);
            add_surface(mesh, i, normal_matrix, orientation, first);
        }
    }

  private:
    void add_surface(const Mesh& mesh, size_t triangle, const glm::mat3& normal_matrix,
                     float orientation, uint32_t first) {
        const glm::uvec3 corners = mesh.triangles[triangle];
        glm::vec3 p[3];
        glm::vec2 uv[3]{};
        SurfaceRecord record{};
        for (uint32_t k = 0; k < 3; k++) {
            p[k] = positions_[first + corners[k]];
            if (!mesh.uvs.empty()) uv[k] = mesh.uvs[corners[k]];
            record.uv[2 * k] = uv[k].x;
            record.uv[2 * k + 1] = uv[k].y;
        }
        const glm::vec3 geometric =
            unit_or(glm::cross(p[1] - p[0], p[2] - p[0]) * orientation, glm::vec3(0, 0, 1));
        bool flat = true;
        for (uint32_t k = 0; k < 3; k++) {
            glm::vec3 n = geometric;
            if (!mesh.normals.empty())
                n = unit_or(normal_matrix * mesh.normals[corners[k]], geometric);
            record.normal[k] = encode_octahedral(n);
            record.geometric[k] = geometric[k];
            flat &= record.normal[k] == encode_octahedral(geometric);
        }
        const uint32_t material = mesh.materials[triangle];
        record.material = material | (flat ? SURFACE_FLAT : 0);
        record.tangent = encode_tangent(p, uv, geometric);
        record.light = NO_INDEX;
        if (emits(scene_.materials[material]))
            flat_.emissive.push_back({uint32_t(flat_.surfaces.size()), material, LIGHT_TRIANGLE,
                                      p[0], p[1] - p[0], p[2] - p[0], 0.0f, orientation});
        flat_.surfaces.push_back(record);
    }

    const Scene& scene_;
    FlatGeometry& flat_;
    std::vector<glm::vec3>& positions_;
    std::vector<glm::uvec3>& triangles_;
};

void add_sphere(const Scene& scene, FlatGeometry& flat, const Sphere& sphere) {
    SurfaceRecord record{};
    for (uint32_t k = 0; k < 3; k++) record.geometric[k] = sphere.center[k];
    record.uv[0] = sphere.radius;
    record.material = sphere.material | SURFACE_SPHERE;
    record.light = NO_INDEX;
    if (emits(scene.materials[sphere.material]))
        flat.emissive.push_back({uint32_t(flat.surfaces.size()),
                                 sphere.material,
                                 LIGHT_SPHERE,
                                 sphere.center,
                                 {},
                                 {},
                                 sphere.radius,
                                 1.0f});
    flat.surfaces.push_back(record);
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
        if (light) add_emissive(shape);
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
        SurfaceRecord record{};
        record.tangent = uint32_t(shape.kind);
        record.uv[0] = shape.minor_radius;
        record.material = shape.material | SURFACE_SHAPE;
        record.light = NO_INDEX;
        const ShapeInput& input =
            flat_.shapes.emplace_back(ShapeInput{uint32_t(shape.kind), shape.minor_radius});
        flat_.geometries.push_back(
            {{}, {}, {}, uint32_t(flat_.surfaces.size()), std::span(&input, 1)});
        flat_.surfaces.push_back(record);
        return uint32_t(flat_.geometries.size() - 1);
    }

    /// A disk is a light to sample. Its front is toward +Y, where cross(Z, X) points.
    void add_emissive(const Shape& shape) {
        const glm::mat4& m = shape.object_to_world;
        flat_.emissive.push_back({uint32_t(flat_.surfaces.size() - 1), shape.material,
                                  shape.kind == ShapeKind::disk ? LIGHT_DISK : NO_INDEX,
                                  glm::vec3(m[3]), glm::vec3(m[2]), glm::vec3(m[0]), 0.0f,
                                  glm::determinant(glm::mat3(m)) < 0 ? -1.0f : 1.0f});
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
