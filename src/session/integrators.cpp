#include "session/integrators.h"

#include "chapter/raster_depth_buffer.h"
#include "chapter/raster_painter.h"
#include "core/error.h"
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

} // namespace onde
