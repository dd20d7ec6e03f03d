// What the things of a scene are called in pictures that tell them apart.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace onde {

/// Of each object (instances, then spheres, then shapes), of what it came with, and of each
/// material. Several things may have one name. UTF-8.
struct IdNames {
    std::vector<std::string> objects, assets, materials;

    bool operator==(const IdNames&) const = default;
};

/// What has no name is called "object N" or "material N", and by its mesh's name if that has one.
/// What came with nothing is an asset of its own.
IdNames id_names(const Scene& scene);

} // namespace onde
