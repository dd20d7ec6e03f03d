#include "session/integrators.h"

#include "chapter/raster_depth_buffer.h"
#include "chapter/raster_painter.h"
#include "chapter/whitted_estimator.h"
#include "core/error.h"
#include "render/light_integrator.h"
#include "render/wave_integrator.h"

namespace onde {

static std::unique_ptr<Integrator> make_whitted(const IntegratorContext& context) {
    const RenderOptions options = with_room_for_nodes(context.options);
    const IntegratorContext with_room{context.programs, context.description,
                                      context.scene,    context.camera,
                                      options,          context.profiler};
    return std::make_unique<WaveIntegrator>(with_room, [&](RenderBuffers& buffers) {
        return std::make_unique<WhittedEstimator>(buffers, *context.description, options);
    });
}

std::unique_ptr<Integrator> make_integrator(const IntegratorContext& context) {
    switch (context.options.integrator) {
    case IntegratorKind::path:
        return std::make_unique<WaveIntegrator>(context, [&](RenderBuffers&) {
            return std::make_unique<PathEstimator>(context.options,
                                                   context.scene.packed().features);
        });
    case IntegratorKind::whitted:
        return make_whitted(context);
    case IntegratorKind::light:
        return make_light_integrator(context);
    case IntegratorKind::depth_buffer:
        return make_depth_buffer(context, best_depth_atomics(context.device().facts()));
    case IntegratorKind::painter:
        return make_painter(context);
    }
    throw InputError("this integrator is not known");
}

static void plan_whitted(RenderBuffers& buffers, const Scene& scene, const RenderOptions& given) {
    const RenderOptions options = with_room_for_nodes(given);
    plan_engine(buffers, WhittedEstimator(buffers, scene, options).shape(), options);
}

MemoryPlan plan_memory(const Scene& scene, const RenderOptions& options,
                       const gpu::DeviceFacts& facts, const SceneFeatures& features) {
    RenderBuffers buffers;
    plan_film(buffers.film, options);
    switch (options.integrator) {
    case IntegratorKind::path:
        plan_engine(buffers, PathEstimator(options, features).shape(), options);
        break;
    case IntegratorKind::whitted:
        plan_whitted(buffers, scene, options);
        break;
    case IntegratorKind::light:
        plan_engine(buffers, LightEstimator(buffers, scene, features, options).shape(), options);
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
