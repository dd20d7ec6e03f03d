// The scene's meshes, spheres and shapes as primitives with ids: what is baked into world space,
// what stays an instance, and a SurfaceRecord for each primitive.
#pragma once

#include "accel/bvh.h"
#include "scene/scene.h"
#include "shared/scene.h"

#include <deque>
#include <vector>

namespace onde {

/// A primitive that emits light, in world space.
struct EmissivePrimitive {
    uint32_t primitive = 0; ///< its SurfaceRecord
    uint32_t material = 0;
    uint32_t kind = LIGHT_TRIANGLE; ///< LIGHT_TRIANGLE, LIGHT_SPHERE, LIGHT_DISK, or NO_INDEX for
                                    ///< shapes whose light only rays find
    glm::vec3 position{0.0f};       ///< first corner, or centre
    glm::vec3 edge1{0.0f}, edge2{0.0f}; ///< of a disk: two conjugate radii
    float radius = 0.0f;
    float orientation = 1.0f; ///< -1 when the front face looks against cross(edge1, edge2)
};

/// Geometry 0 is baked: everything that is placed once, is small or emits, in world space. Each
/// further geometry is a mesh or a shape in its own space, placed by the placements after the
/// first.
struct FlatGeometry {
    std::vector<Geometry> geometries;
    std::vector<Placement> placements;
    std::vector<SurfaceRecord> surfaces; ///< by primitive id
    std::vector<EmissivePrimitive> emissive;

    // What the spans of `geometries` point to.
    std::deque<std::vector<glm::vec3>> positions;
    std::deque<std::vector<glm::uvec3>> triangles;
    std::vector<SphereInput> spheres;
    std::deque<ShapeInput> shapes;
};

/// Meshes placed several times are baked all the same while their copies stay below this.
inline constexpr uint64_t BAKED_COPIES = 1u << 11;

FlatGeometry flatten_geometry(const Scene& scene);

} // namespace onde
