// The probes of bsdf.cl for light that comes along wo, as light tracing has it.
#define ONDE_ADJOINT 1
#include "probe/bsdf.cl"
