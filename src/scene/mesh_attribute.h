// Numbers that a PLY file has of its vertices or faces beside those that every mesh has.
#pragma once

#include <glm/glm.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace onde {

enum class AttributeOf { vertices, faces };

/// Those of an attribute, row by row: of "color" what color_0, color_1 and color_2 say, or color_0
/// alone, which then stands for all three. Nothing where the file lacks it. `name` is used in error
/// sentences; throws InputError where the file is no PLY file, or a damaged one.
std::vector<glm::dvec3> ply_attribute(const std::string& name, std::string_view file,
                                      AttributeOf of, std::string_view attribute);

} // namespace onde
