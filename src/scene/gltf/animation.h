// Animations of glTF (section 3.11): nodes as they stand at a moment.
#pragma once

#include "scene/gltf/file.h"

namespace onde::gltf {

/// Moves the document's nodes to the moment that the load's options ask for, by the animation they
/// name or else by all that do not move the same things; without a moment, a note says what there
/// is. Times beyond an animation's ends are its ends. Throws InputError for accessors that lie and
/// for an animation that is not there.
void animate_nodes(File& file);

} // namespace onde::gltf
