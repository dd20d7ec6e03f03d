// Pictures of the checks, by kernels that can do what the built-in scene and the furnaces ask, so
// that they share their programs.
#pragma once

#include "doctor/check.h"
#include "render/options.h"
#include "session/session.h"

namespace onde::doctor {

/// The device's settings.
RenderOptions picture_options(const CheckContext& context, uint32_t width, uint32_t height,
                              uint32_t samples);

/// Those of the built-in picture.
RenderOptions built_in_options(const CheckContext& context);

/// With the layout that suits the device, or that one.
SessionOptions session_options(const CheckContext& context, const RenderOptions& render,
                               std::optional<BvhLayout> layout = {});

/// The picture of a scene.
Image picture_of(const CheckContext& context, const Scene& scene, const RenderOptions& render,
                 std::optional<BvhLayout> layout = {});

} // namespace onde::doctor
