// What an MTL file says: its materials as written, before anything is made of them.
#pragma once

#include "scene/obj/mtl_map.h"

#include <glm/glm.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde::mtl {

/// Numbers are finite. What is not written is absent, or has the value that changes nothing.
struct Material {
    std::string name;
    std::optional<glm::vec3> diffuse;                             ///< Kd
    glm::vec3 specular{0.0f}, emission{0.0f}, transmission{0.0f}; ///< Ks, Ke, Tf
    float exponent = 1.0f, ior = 1.0f;                            ///< Ns, Ni
    std::optional<float> opacity, transparency;                   ///< d, Tr
    float illumination = 0.0f;                                    ///< illum
    float roughness = 0.0f, metallic = 0.0f;                      ///< Pr, Pm
    Map diffuse_map, emission_map, normal_map;                    ///< map_Kd, map_Ke, norm
    Map opacity_map;                                              ///< map_d
};

/// Reads the text of an MTL file. Nothing in it is an error: what is not used or makes no sense is
/// noted.
std::vector<Material> read(std::string_view text, Notes& notes);

} // namespace onde::mtl
