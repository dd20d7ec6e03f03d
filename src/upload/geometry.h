// The scene's meshes, spheres and shapes as primitives with ids: what is baked into world space,
// what stays an instance, and a SurfaceRecord for each primitive.
#pragma once

#include "accel/bvh.h"
#include "scene/scene.h"
#include "shared/scene.h"
#include "upload/emissive.h"
#include "upload/objects.h"

#include <deque>
#include <vector>

namespace onde {

/// Geometry 0 is baked: everything that is placed once, is small or emits, and does not move while
/// the shutter is open, in world space. Each
/// further geometry is a mesh or a shape in its own space, placed by the placements after the
/// first.
struct FlatGeometry {
    std::vector<Geometry> geometries;
    std::vector<Placement> placements;
    std::vector<SurfaceRecord> surfaces; ///< by primitive id
    std::vector<uint32_t> bulges;        ///< likewise, empty where no triangle is curved
    std::vector<float> uv_scales;        ///< likewise, empty where no texture has coarser levels
    std::vector<VertexRecord> vertices;  ///< the first: of triangles that have none of their own
    /// By index of the vertex, each empty where the scene does not need it; see SCENE_BUFFERS.
    std::vector<float> uvs;
    std::vector<uint32_t> uv_sets; ///< used_uv_sets()
    std::vector<uint32_t> colors, tangents;
    std::vector<EmissivePrimitive> emissive;
    ObjectMap objects;

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
