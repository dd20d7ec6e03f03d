#include "render/integrator.h"

#include "render/wave_integrator.h"

namespace onde {

std::unique_ptr<Integrator>
make_path_integrator(const gpu::Device& device, const gpu::KernelSources& sources,
                     const gpu::ProgramCache* cache, const DeviceScene& scene, const Camera& camera,
                     const RenderOptions& options, gpu::Profiler* profiler) {
    return make_wave_integrator({device, sources, cache, nullptr, scene, camera, options, profiler},
                                make_engine);
}

} // namespace onde
