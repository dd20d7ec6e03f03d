// What of a glTF file its chosen scene shows, before anything of it is loaded.
#pragma once

#include "scene/gltf/file.h"

#include <vector>

namespace onde::gltf {

/// The roots of the scene that the options choose, or of the default one; of a file without scenes,
/// the nodes that no other has as a child. Throws InputError where there is no such scene.
std::vector<uint32_t> root_nodes(const File& file);

/// The variant that the options choose, if they do. Throws InputError where there is none.
Index chosen_variant(const File& file);

/// The material in a variant, or the primitive's own.
Index material_of(const Primitive& primitive, Index variant);

/// Of each of the document's materials, whether something of the scene may have it.
std::vector<bool> shown_materials(const File& file);

} // namespace onde::gltf
