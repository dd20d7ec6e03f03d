// Lambert's reflector. Local directions, both above the surface.
#ifndef ONDE_SHADE_LOBES_DIFFUSE_H
#define ONDE_SHADE_LOBES_DIFFUSE_H

#include "math/sampling.h"

INLINE real3 diffuse_sample(real2 u) {
    return sample_cosine_hemisphere(u);
}
INLINE real diffuse_pdf(real3 wi) {
    return pdf_cosine_hemisphere(wi.z);
}
// BSDF times cosine.
INLINE real3 diffuse_eval(real3 albedo, real3 wi) {
    return scale3(albedo, max_real(wi.z, (real)(0.0f)) * INV_PI);
}

#endif
