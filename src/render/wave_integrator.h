// Integrators whose passes are cut into waves for an engine.
#pragma once

#include "render/integrator.h"

namespace onde {

/// An integrator around the engine that `make` makes of its context. The device outlives it, as
/// does what the context refers to.
using EngineFactory = std::function<std::unique_ptr<EngineDriver>(const EngineContext&)>;
std::unique_ptr<Integrator> make_wave_integrator(const IntegratorContext& context,
                                                 const EngineFactory& make);

} // namespace onde
