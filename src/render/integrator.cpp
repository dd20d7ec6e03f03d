#include "render/integrator.h"

#include "render/wave_integrator.h"

namespace onde {

std::unique_ptr<Integrator> make_path_integrator(gpu::Programs& programs, const DeviceScene& scene,
                                                 const Camera& camera, const RenderOptions& options,
                                                 gpu::Profiler* profiler) {
    return std::make_unique<WaveIntegrator>(
        IntegratorContext{programs, nullptr, scene, camera, options, profiler},
        [](RenderBuffers&) { return std::make_unique<PathEstimator>(); });
}

} // namespace onde
