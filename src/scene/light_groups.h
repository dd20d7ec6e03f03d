// Groups of lights: names that materials, lights and the environment may share. A film can have the
// light of each group by itself, and so compositors can dim one after the render.
#pragma once

#include "scene/scene.h"

#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// That of all light which has no other.
inline constexpr std::string_view OTHER_LIGHT = "other";
inline constexpr size_t MOST_LIGHT_GROUPS = 16; ///< beside that

/// What is wrong with the name of a group, to follow it; or nothing.
std::string why_no_group(const std::string& name);

/// OTHER_LIGHT, then the scene's groups in the order of materials, lights and environment. Throws
/// InputError where there are too many.
std::vector<std::string> light_groups(const Scene& scene);

/// Finds the number of a group.
class LightGroups {
  public:
    explicit LightGroups(const Scene& scene) : names_(light_groups(scene)) {}
    uint32_t operator()(const std::string& name) const;

  private:
    std::vector<std::string> names_;
};

} // namespace onde
