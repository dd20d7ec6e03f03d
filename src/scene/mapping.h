// What an integrator makes of a scene that was written for another one, in words.
#pragma once

#include "scene/scene.h"

#include <string>
#include <vector>

namespace onde {

/// What of a complete scene this integrator maps to something else or leaves out, a sentence each;
/// nothing for a scene that is all its own. What depends on the picture is left to the
/// integrator's findings.
std::vector<std::string> mapping_notes(const Scene& scene, IntegratorKind integrator);

} // namespace onde
