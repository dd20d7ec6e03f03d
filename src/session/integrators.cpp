#include "session/integrators.h"

#include "chapter/raster_depth_buffer.h"
#include "chapter/raster_painter.h"
#include "core/error.h"
#include "render/light_integrator.h"
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
        return make_depth_buffer(context, best_depth_atomics(context.device().facts()));
    case IntegratorKind::painter:
        return make_painter(context);
    }
    throw InputError("this integrator is not known");
}

MemoryPlan plan_memory(const Scene& scene, const RenderOptions& options,
                       const gpu::DeviceFacts& facts) {
    RenderBuffers buffers;
    plan_film(buffers.film, options);
    switch (options.integrator) {
    case IntegratorKind::path:
        plan_engine(buffers, options);
        break;
    case IntegratorKind::whitted:
        plan_whitted_engine(buffers, scene, options);
        break;
    case IntegratorKind::light:
        plan_light_integrator(buffers, options);
        break;
    case IntegratorKind::depth_buffer:
        plan_depth_buffer(buffers, scene, options);
        break;
    case IntegratorKind::painter:
        plan_painter(buffers, scene, options, facts);
        break;
    }
    return buffers.sizes();
}

} // namespace onde
