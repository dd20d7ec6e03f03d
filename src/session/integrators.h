// The choice of the integrator: a line for each.
#pragma once

#include "render/integrator.h"

namespace onde {

/// The integrator that the options name. The scene and device outlive it.
std::unique_ptr<Integrator> make_integrator(const IntegratorContext& context);

} // namespace onde
