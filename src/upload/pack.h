// A scene and its acceleration structure as device records, still in host memory. Pure.
#pragma once

#include "accel/bvh.h"
#include "gpu/buffer_list.h"
#include "scene/extent.h"
#include "scene/scene.h"
#include "shared/frame.h"
#include "upload/appearance.h"
#include "upload/features.h"
#include "upload/lights.h"
#include "upload/motion.h"
#include "upload/textures.h"

#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace onde {

/// The arrays of SCENE_BUFFERS, MORE_TEXEL_BUFFERS and MIP_BUFFERS in shared/scene.h.
struct SceneArrays {
#define ONDE_ARRAY(Type, name, words) std::vector<Type> name;
    SCENE_BUFFERS(ONDE_ARRAY)
    MORE_TEXEL_BUFFERS(ONDE_ARRAY)
    MIP_BUFFERS(ONDE_ARRAY)
#undef ONDE_ARRAY
};

/// All that may be on the device, beside the tree.
#define PACKED_BUFFERS(BUFFER)                                                                     \
    SCENE_BUFFERS(BUFFER)                                                                          \
    MOTION_BUFFERS(BUFFER) MORE_TEXEL_BUFFERS(BUFFER) MIP_BUFFERS(BUFFER)

struct PackedScene : SceneArrays, MotionArrays {
    Bvh bvh;
    double built_cost = 0; ///< SAH cost of the tree before it was fitted to anything else
    uint32_t environment_light = NO_INDEX; ///< index into the lights
    SunRange suns;                         ///< among the lights
    glm::vec3 environment_radiance{0.0f};  ///< scale of the map, where there is one
    uint32_t environment_group = 0;        ///< of light_groups()
    float environment_rotation = 0.0f;     ///< radians
    float environment_floor = 0, environment_scale[MAP_TABLES] = {1, 1}; ///< of PackedEnvironment
    std::vector<Camera> next_cameras{}; ///< at the next frame, where the scene has one
    float next_environment_rotation = 0.0f;
    std::vector<uint32_t> camera_movers{}; ///< by camera, see FrameRecord; empty: none moves
    std::optional<Extent> bounds{};        ///< of the geometry, where a camera has parallel rays
    glm::vec3 ground_share{0.0f};          ///< one over the irradiance that the ground receives
    float ground_height = std::numeric_limits<float>::infinity(); ///< no ground: above all rays
    uint32_t environment_width = 0, environment_height = 0;       ///< 0 when it is constant
    ObjectMap objects;
    SceneFeatures features;

    /// The buffers that the scene takes on the device.
    std::vector<gpu::BufferSize> device_buffers() const;
    /// Their sum.
    uint64_t device_bytes() const { return gpu::total_bytes(device_buffers()); }
    /// What of it textures take.
    uint64_t texture_bytes() const;
};

/// The scene must satisfy check_scene().
PackedScene pack_scene(const Scene& scene, const BvhOptions& options = {},
                       const LightOptions& lights = {}, const TextureOptions& textures = {});

/// Takes over how the scene is seen at the next frame.
void take_next_view(PackedScene& packed, const Scene& scene);

/// The box of a scene with an orthographic camera; nothing for any other.
std::optional<Extent> bounds_for_parallel_rays(const Scene& scene);

/// What of a scene has changed since it was packed; each includes those before it.
enum class SceneChange {
    none,
    materials,  ///< but not what they emit
    transforms, ///< of instances and shapes
    lights,     ///< what materials emit, which decides what is baked
};

/// Packs what has changed anew: the same, but for the tree's shape, as pack_scene() of the scene
/// as it is now. Where only transforms have changed, the tree is fitted to them as long as that
/// makes it no more than MOST_REFIT_COST times as costly as it was built. `options` and `lights`
/// are those that it was packed with.
void repack_scene(PackedScene& packed, const Scene& scene, SceneChange change,
                  const BvhOptions& options = {}, const LightOptions& lights = {});
inline constexpr double MOST_REFIT_COST = 1.5;

} // namespace onde
