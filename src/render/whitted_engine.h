// The Whitted estimator's engines: staged and fused wavefront, and the megakernel.
#pragma once

#include "render/engine.h"

namespace onde {

/// States the buffers of an engine of these options.
void plan_whitted_engine(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options);

/// The engine that the options name. The scene is the one that the context's device scene was
/// packed from; it is not kept.
std::unique_ptr<EngineDriver> make_whitted_engine(const EngineContext& context, const Scene& scene);

} // namespace onde
