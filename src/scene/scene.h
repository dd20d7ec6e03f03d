// A scene as plain values, in world units and linear RGB. What the loaders make, what upload packs,
// what the tests' reference renders. It knows nothing of files or devices.
//
// Conventions: right-handed, Y up as in glTF; a camera looks along its local -Z with +Y up;
// radiometric units (radiance W/(sr m^2), intensity W/sr, irradiance W/m^2), per RGB channel.
#pragma once

#include "scene/camera.h"
#include "scene/chapter_scene.h"
#include "scene/geometry.h"
#include "scene/light.h"
#include "scene/material.h"
#include "scene/next_frame.h"
#include "scene/settings.h"

#include <filesystem>
#include <string>
#include <vector>

namespace onde {

struct Scene {
    glm::dvec3 origin{0.0}; ///< in the file's coordinates: where positions are counted from
    int exponent = 0;       ///< of two, by which loading has multiplied lengths
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Sphere> spheres;
    std::vector<Shape> shapes;
    std::vector<PlacedName> names; ///< of instances, spheres and shapes
#define ONDE_LIST(Type, list, words) std::vector<Type> list;
    LIGHT_LISTS(ONDE_LIST)
#undef ONDE_LIST
    Environment environment;
    Medium medium;                    ///< around everything, where nothing else is
    std::vector<DensityGrid> grids{}; ///< of media
    bool has_studio = false;          ///< the environment is the studio that loading has added
    std::vector<Camera> cameras;
    std::optional<NextFrame> next{}; ///< of an animation, where it is asked for
    RenderSettings settings;
    ChapterScene chapter;
    std::vector<std::filesystem::path> files; ///< that it was read from, or may have been
    std::vector<std::string> notes; ///< what was mapped, ignored or added, a sentence each
};

/// Calls visit(list, intensities, words) for each list of lights without geometry, with what the
/// chapter states of them.
template <class AnyScene, class Visit>
void for_each_light_list(AnyScene& scene, const Visit& visit) {
#define ONDE_VISIT(Type, list, words) visit(scene.list, scene.chapter.intensities.list, words);
    LIGHT_LISTS(ONDE_VISIT)
#undef ONDE_VISIT
}

/// Calls visit(medium) for what is around everything, and what is inside of materials.
template <class AnyScene, class Visit>
void for_each_medium(AnyScene& scene, const Visit& visit) {
    visit(scene.medium);
    for (auto& material : scene.materials)
        if (material.medium) visit(*material.medium);
}

} // namespace onde
