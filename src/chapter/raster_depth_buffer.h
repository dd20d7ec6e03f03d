// The depth buffer (chapter 1.1): of all that covers a pixel, the nearest stays.
#pragma once

#include "chapter/raster_scene.h"

namespace onde {

/// How fragments that reach a pixel at the same time are settled; the picture is the same.
enum class DepthAtomics {
    wide,   ///< depth and primitive in one 64-bit atomic minimum
    narrow, ///< two passes of 32-bit ones: the depths, then the primitives that are as near
};

/// The wide ones where the device has them.
DepthAtomics best_depth_atomics(const gpu::DeviceFacts& facts);

/// States the buffers of a depth buffer of these options.
void plan_depth_buffer(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options);

std::unique_ptr<Integrator> make_depth_buffer(const IntegratorContext& context,
                                              DepthAtomics atomics);

} // namespace onde
