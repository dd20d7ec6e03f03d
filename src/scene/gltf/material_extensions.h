// What extensions of glTF add to metallic-roughness materials: KHR_materials_...
#pragma once

#include "scene/gltf/textures.h"

namespace onde::gltf {

/// Reads all of them that a material has. `user`: what notes call it.
void apply_extensions(TextureLoader& textures, const JsonReader& source, const std::string& user,
                      Material& material);

} // namespace onde::gltf
