// MTL materials to ours.
#pragma once

#include "scene/find_file.h"
#include "scene/notes.h"
#include "scene/obj/mtl.h"
#include "scene/scene.h"

#include <string>

namespace onde {

/// The material and the textures it uses, which are added to `scene`; they lie in `folder`, within
/// the finder's, or in that. A texture that is missing, outside of the folder or damaged is left
/// out, with a note.
Material convert_mtl(const mtl::Material& source, Scene& scene, FileFinder& files,
                     const std::string& folder, Notes& notes);

} // namespace onde
