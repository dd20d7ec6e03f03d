// How things move while the shutter is open: what motion blur shows.
#pragma once

#include <glm/glm.hpp>

#include <filesystem>
#include <vector>

namespace onde {

struct Scene;
struct LoadOptions;

/// Where a thing is at equal steps from the opening of the shutter to its closing. Between them its
/// matrix is mixed; empty of what stands still.
using MotionKeys = std::vector<glm::mat4>;

/// Of each thing of a scene that has a transform. The first key is the scene's own.
struct ShutterMotion {
    std::vector<MotionKeys> instances, shapes, cameras;

    /// Whether nothing moves.
    bool empty() const;
};

/// Where a thing is on its way from one place to another one, after that share of it: it moves
/// straight, turns evenly and stretches linearly (Shoemake and Duff, "Matrix animation and polar
/// decomposition", 1992).
glm::dmat4 between(const glm::dmat4& from, const glm::dmat4& to, double share);

/// The keys of a thing that is at these places at equal steps, at least two, and between() them.
/// There are as many keys as it takes for mixed matrices to turn points on circles that are no more
/// than 2e-4 of their radius too small.
MotionKeys motion_keys(const std::vector<glm::mat4>& places);

/// Gives a scene, which load_scene() has loaded from there with these options, how it moves from
/// its moment on for `seconds`, of which the file is asked; notes what of it is not blurred. The
/// scene has no shutter where nothing moves. Throws InputError as load_scene() does.
void load_shutter(Scene& scene, const std::filesystem::path& path, LoadOptions options,
                  double seconds);

} // namespace onde
