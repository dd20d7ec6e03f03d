// What an STL file says, binary or ASCII: polygons of positions, before they become a mesh.
#pragma once

#include "scene/notes.h"

#include <glm/glm.hpp>

#include <functional>
#include <span>
#include <string>
#include <string_view>

namespace onde::stl {

/// Takes the corners of a facet, three or more; they may be NaN or infinite.
using AddFacet = std::function<void(std::span<const glm::dvec3>)>;

/// Reads the file whose bytes these are; size and content tell binary from ASCII, not the word
/// "solid" alone, with which binary headers begin as well. Throws InputError, beginning with
/// `name`, when it is neither, or is shorter than its header says.
void read(const std::string& name, std::string_view bytes, const AddFacet& add, Notes& notes);

} // namespace onde::stl
