// Primitives compressed by KHR_draco_mesh_compression, decoded by libdraco.
#pragma once

#include "scene/gltf/file.h"

namespace onde::gltf {

/// Decodes the primitive, if it is compressed, into `file.decoded_elements` for its accessors.
/// Throws InputError for damaged data, and where it would take more than the load's budget.
void decode_draco(File& file, const Primitive& primitive, const std::string& user);

} // namespace onde::gltf
