// Cameras and what a pbrt file asks of a render.
#pragma once

#include "scene/notes.h"
#include "scene/pbrt/parameters.h"
#include "scene/scene.h"

namespace onde::pbrt {

/// Takes what a directive ("Film", "Sampler", "Integrator", "PixelFilter") asks for.
void read_setting(std::string_view directive, const std::string& kind, const Parameters& parameters,
                  RenderSettings& settings, Notes& notes);

/// What is not asked for as pbrt has it.
void complete_settings(RenderSettings& settings);

/// The camera, of pictures of the settings' size. It looks along -Z of its own space.
Camera camera_of(const std::string& kind, const Parameters& parameters,
                 const RenderSettings& settings, Notes& notes);

} // namespace onde::pbrt
