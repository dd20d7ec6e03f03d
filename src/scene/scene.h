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
#include "scene/settings.h"

#include <string>
#include <vector>

namespace onde {

struct Scene {
    std::vector<Texture> textures;
    std::vector<Material> materials;
    std::vector<Mesh> meshes;
    std::vector<Instance> instances;
    std::vector<Sphere> spheres;
    std::vector<Shape> shapes;
    std::vector<PointLight> point_lights;
    std::vector<DirectionalLight> directional_lights;
    Environment environment;
    std::vector<Camera> cameras;
    RenderSettings settings;
    ChapterScene chapter;
    std::vector<std::string> notes; ///< what was mapped, ignored or added, a sentence each
};

} // namespace onde
