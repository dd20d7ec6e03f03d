// The steps from a parsed glTF file to a Scene, in the order in which gltf.cpp takes them.
#pragma once

#include "scene/gltf_file.h"
#include "scene/scene.h"

namespace onde::gltf {

/// Appends one Material for each of the file's and then the default one, with the textures used.
void add_materials(File& file, Scene& scene);

/// Appends one Mesh for each of the file's; may be without triangles.
void add_meshes(File& file, Scene& scene);

/// Traversals the default scene: instances, cameras and lights.
void add_nodes(File& file, Scene& scene);

} // namespace onde::gltf
