// The choice of the integrator: a line for each.
#include "render/integrator.h"

#include "core/error.h"
#include "render/raster_depth_buffer.h"
#include "render/raster_painter.h"
#include "render/wave_integrator.h"
#include "render/whitted_engine.h"

namespace onde {

std::unique_ptr<Integrator> make_integrator(const IntegratorContext& context) {
    switch (context.options.integrator) {
    case IntegratorKind::path:
        return make_wave_integrator(context, make_engine);
    case IntegratorKind::whitted:
        return make_wave_integrator(context, [&](const EngineContext& engine) {
            return make_whitted_engine(engine, *context.description);
        });
    case IntegratorKind::light:
        return make_light_integrator(context);
    case IntegratorKind::depth_buffer:
        return make_depth_buffer(context, best_depth_atomics(context.device.facts()));
    case IntegratorKind::painter:
        return make_painter(context);
    }
    throw InputError("this integrator is not known");
}

std::unique_ptr<Integrator>
make_path_integrator(const gpu::Device& device, const gpu::KernelSources& sources,
                     const gpu::ProgramCache* cache, const DeviceScene& scene, const Camera& camera,
                     const RenderOptions& options, gpu::Profiler* profiler) {
    return make_wave_integrator({device, sources, cache, nullptr, scene, camera, options, profiler},
                                make_engine);
}

} // namespace onde
