// The choice of the integrator: a line for each.
#pragma once

#include "render/integrator.h"

namespace onde {

/// The integrator that the options name. The scene and device outlive it.
std::unique_ptr<Integrator> make_integrator(const IntegratorContext& context);

/// The buffers that the integrator of these options will allocate on such a device, for a scene
/// that has these features when it is packed; the scene's part lacks those of the packed scene.
MemoryPlan plan_memory(const Scene& scene, const RenderOptions& options,
                       const gpu::DeviceFacts& facts, const SceneFeatures& features = {});

} // namespace onde
