// A map statement of an MTL file: options and a file name, both of which may hold blanks.
#pragma once

#include "scene/notes.h"

#include <glm/glm.hpp>

#include <string>
#include <string_view>

namespace onde::mtl {

struct Map {
    std::string file; ///< as written; empty for no map
    bool clamp = false;
    float bump = 1.0f;                  ///< -bm
    glm::dvec2 scale{1.0}, offset{0.0}; ///< of texture coordinates: uv * scale + offset

    bool moves_uvs() const { return scale != glm::dvec2(1.0) || offset != glm::dvec2(0.0); }
};

/// Reads what follows the keyword; options may stand before and after the name. Options that would
/// change the picture and are left out are noted, with `material` as the example.
Map read_map(std::string_view text, const std::string& material, Notes& notes);

} // namespace onde::mtl
