// Puts scenes into scenes: the one way by which includes and loaders are joined.
#pragma once

#include "scene/scene.h"

namespace onde {

/// The most instances of a scene; and the most spheres, shapes, lights, cameras.
inline constexpr size_t MAX_PLACED = size_t(1) << 22;

/// Where the assets of a part begin in the whole.
struct AssetOffsets {
    uint32_t textures = 0, materials = 0, meshes = 0, names = 0, grids = 0;
    /// Where the grids of its materials' media lie in the part, by material.
    std::vector<glm::mat4> media{};
};

/// Moves the textures, materials, meshes, names and grids of `part` to the end of those of `whole`.
AssetOffsets append_assets(Scene& whole, Scene& part);

/// Places the instances, spheres, lights and cameras of `part`, whose assets lie at `offsets` in
/// `whole`, by an affine, invertible transform; and the grids of its media, of which a part that is
/// placed several times has one in the last place only. Lengths scale, intensities don't;
/// environment and
/// settings are taken where `whole` has none, and a note says that others of [whitted] are left
/// out. Throws InputError when a sphere would be stretched or
/// when there would be more than 2^22 instances, spheres, shapes, lights or cameras.
void append_placed(Scene& whole, const Scene& part, const AssetOffsets& offsets,
                   const glm::mat4& transform);

/// Bytes that placing the part takes, with what upload makes of its instances and lights.
uint64_t placed_bytes(const Scene& part);

/// Both of the above and the notes: all of `part` becomes part of `whole`.
void append(Scene& whole, Scene&& part, const glm::mat4& transform = glm::mat4(1.0f));

/// Places everything in the scene anew, as append() would. Intensities don't scale.
void place_anew(Scene& scene, const glm::mat4& transform);

/// The factor of an even scale, or 0 for any other transform.
float even_scale(const glm::mat4& transform);

/// A camera placed anew; its lengths scale.
Camera placed(Camera camera, const glm::mat4& transform);

/// Rotation and translation of a camera placed by `transform`: scale, shear and mirroring removed.
glm::mat4 rigid_part(const glm::mat4& transform);

/// Whether the scene's environment emits anything.
bool emits(const Environment& environment);

} // namespace onde
