// Attributes of meshes that scenes of other renderers name: colours and weights that PLY files have
// by vertex or face.
#pragma once

#include "scene/load_context.h"
#include "scene/scene.h"

#include <filesystem>
#include <string>

namespace onde {

/// What colours a mesh: "vertex_color" are the properties color_0, color_1 and color_2 of its
/// file's vertices. Of three numbers each is a colour's; a single one mixes all of them.
struct MeshAttribute {
    std::string name;
    glm::vec3 at_zero{0.0f}, at_one{1.0f}; ///< the colours that stand for 0 and for 1
};

/// Gives the mesh, which is that of the PLY file, the attribute as colours of its vertices; where
/// it belongs to faces, each gets vertices of its own. False where the file does not have it, or
/// not for each vertex or triangle.
bool color_by(Mesh& mesh, const std::filesystem::path& file, const MeshAttribute& attribute,
              LoadContext& context);

} // namespace onde
