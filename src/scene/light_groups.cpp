#include "scene/light_groups.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>

namespace onde {

std::string why_no_group(const std::string& name) {
    const bool is_plain =
        std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; });
    return is_plain ? "" : "must be of letters, digits and _ only";
}

std::vector<std::string> light_groups(const Scene& scene) {
    std::vector<std::string> names{std::string(OTHER_LIGHT)};
    const auto add = [&](const std::string& name) {
        if (name.empty() || std::ranges::find(names, name) != names.end()) return;
        if (names.size() > MOST_LIGHT_GROUPS)
            throw InputError("the scene has more than {} groups of lights, of which {} is one; "
                             "give fewer lights a group of their own",
                             MOST_LIGHT_GROUPS, name);
        names.push_back(name);
    };
    for (const Material& material : scene.materials) add(material.group);
    for_each_light_list(scene, [&](const auto& lights, const auto&, const char*) {
        for (const auto& light : lights) add(light.group);
    });
    add(scene.environment.group);
    return names;
}

uint32_t LightGroups::operator()(const std::string& name) const {
    const auto found = std::ranges::find(names_, name);
    return found == names_.end() ? 0 : uint32_t(found - names_.begin());
}

} // namespace onde
