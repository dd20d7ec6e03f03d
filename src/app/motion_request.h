// Motion of the pictures of a render: the channel that leads to the next frame, and blur.
#pragma once

#include "app/render_request.h"

namespace onde::app {

/// Frames a second of --frames, and of the next frame of one picture: those of --fps, or 24.
double frames_a_second(const RenderRequest& request);

/// Throws InputError for an --fps that is none, or that nothing can ask for.
void check_frames_a_second(const RenderRequest& request);

/// Where request or scene ask for motion or a shutter, gives a scene that was loaded with these
/// options its next frame, and how it moves while the shutter is open. The scene gets a note of the
/// time that passes until then, where that is not plain. Throws InputError as load_scene() does,
/// and for an --fps that nothing has asked for.
void add_motion(Scene& scene, const RenderRequest& request, const LoadOptions& options);

} // namespace onde::app
