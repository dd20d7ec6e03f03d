// The parallel view of the depth buffer and the painter.
#pragma once

#include "render/options.h"
#include "shared/raster.h"

#include <glm/glm.hpp>

namespace onde {

/// The camera with parallel rays. A perspective one gets the height of view that it frames at the
/// depth of `center`, or at its focus where that lies behind it. The aperture is dropped.
Camera parallel_camera(const Camera& camera, glm::vec3 center);

/// World space to the screen of a parallel camera: x and y in pixels from the upper left corner of
/// the picture, y downward; z the depth along the view in world units.
glm::dmat4 screen_transform(const Camera& camera, const RenderOptions& options);

/// World units per pixel of a parallel camera.
double pixel_size(const Camera& camera, const RenderOptions& options);

/// What parallel rays that meet nothing see: the scene's background, else its environment, whose
/// map is read at its nearest pixel.
glm::vec3 raster_background(const Scene& scene, const Camera& camera);

} // namespace onde
