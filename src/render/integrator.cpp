// The choice of the integrator: a line for each.
#include "render/integrator.h"

#include "core/error.h"

namespace onde {

std::unique_ptr<Integrator> make_integrator(const IntegratorContext& c) {
    switch (c.options.integrator) {
    case IntegratorKind::path:
        return make_path_integrator(c.device, c.sources, c.cache, c.scene, c.camera, c.options,
                                    c.profiler);
    default:
        throw InputError("this integrator is not built yet; use --integrator path");
    }
}

} // namespace onde
