// The scene's shapes in Embree: what a ray meets, and what the surface is like there. It knows
// nothing of materials beyond their index, nor of lights.
#pragma once

#include "scene/scene.h"
#include "support/reference/camera.h"

#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

struct RTCDeviceTy;
struct RTCSceneTy;

namespace onde::reference {

/// Which primitive of which shape. Shapes are the scene's instances, in order, then all spheres.
struct Hit {
    uint32_t shape, primitive;
    glm::vec2 barycentric; ///< of the second and third corner
    glm::vec3 position;    ///< as the ray found it, only approximately on the surface
};

/// A point of a surface, in world space. Normals are unit and on the front side.
struct SurfacePoint {
    glm::vec3 position;
    glm::vec3 geometric_normal;
    glm::vec3 shading_normal;
    uint32_t material;
    float clearance; ///< how far a ray's origin must leave the surface so as not to meet it again
    /// How far the curved surface that a triangle's normals speak of lies above it, on its front
    /// and above its back.
    float front_bulge = 0.0f, back_bulge = 0.0f;
};

/// In world space, counter-clockwise seen from the front.
struct WorldTriangle {
    glm::vec3 p0, e1, e2;
    glm::vec2 uv0, uv1, uv2;
    uint32_t material;
};

/// Derivatives of the position by the texture coordinates; zero where they are undefined.
struct Tangents {
    glm::vec3 dpdu{0.0f}, dpdv{0.0f};
};

/// The origin of a ray that leaves `point` to the side of `direction`.
inline glm::vec3 leave_surface(const SurfacePoint& point, const glm::vec3& direction) {
    const float side = glm::dot(point.geometric_normal, direction);
    return point.position + std::copysign(point.clearance, side) * point.geometric_normal;
}

/// Texture coordinates of a sphere's point in the unit direction d from its centre: laid out as
/// the environment map is.
glm::vec2 sphere_uv(const glm::vec3& d);

class Geometry {
  public:
    explicit Geometry(const Scene& scene);

    std::optional<Hit> intersect(const Ray& ray) const;
    /// Whether anything lies between, `distance` counted in lengths of `direction`.
    bool occluded(const glm::vec3& origin, const glm::vec3& direction, float distance) const;

    SurfacePoint surface_point(const Hit& hit) const;
    glm::vec2 uv(const Hit& hit) const;
    Tangents tangents(const Hit& hit) const;

    uint32_t instance_count() const { return uint32_t(shapes_.size()); }
    uint32_t triangle_count(uint32_t shape) const;
    WorldTriangle triangle(uint32_t shape, uint32_t primitive) const;
    std::span<const Sphere> spheres() const { return spheres_; }
    /// Half the diagonal of the bounding box.
    float radius() const { return radius_; }

  private:
    /// A mesh as Embree holds it, with what shading needs beside it.
    struct MeshData {
        const glm::vec3* positions; ///< owned by Embree
        const glm::uvec3* triangles;
        uint32_t triangle_count;
        std::vector<glm::vec3> normals;
        std::vector<glm::vec2> uvs;
        std::vector<uint32_t> materials;
    };
    /// An instance of a mesh. A mesh that is placed once is baked into the world.
    struct Shape {
        const MeshData* mesh;
        glm::mat4x3 to_world;
        glm::mat3 normal_to_world;
        bool baked;    ///< the mesh is in world space already
        bool mirrored; ///< to_world turns the triangles' winding around
    };
    struct Release {
        void operator()(RTCDeviceTy* device) const;
        void operator()(RTCSceneTy* scene) const;
    };
    using ScenePointer = std::unique_ptr<RTCSceneTy, Release>;

    void add_instances(const Scene& scene);
    void add_spheres();
    /// Builds the mesh, transformed, into `target` under `id`.
    const MeshData* add_mesh(const Mesh& mesh, const glm::mat4& transform, RTCSceneTy* target,
                             uint32_t id);
    void add_placement(RTCSceneTy* content, const glm::mat4& to_world, uint32_t id);
    SurfacePoint sphere_point(const Hit& hit) const;
    SurfacePoint triangle_point(const Hit& hit) const;

    std::unique_ptr<RTCDeviceTy, Release> device_;
    std::vector<ScenePointer> mesh_scenes_; ///< of the meshes that are instanced
    ScenePointer scene_;
    std::vector<std::unique_ptr<MeshData>> meshes_;
    std::vector<Shape> shapes_;
    std::vector<Sphere> spheres_;
    float radius_ = 1.0f;
};

} // namespace onde::reference
