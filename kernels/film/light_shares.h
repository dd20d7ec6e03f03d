// Into which AOVs light goes that arrives at the camera: by the number of surfaces that have turned
// it, and by what the first surface on the camera's way did with it.
#ifndef ONDE_FILM_LIGHT_SHARES_H
#define ONDE_FILM_LIGHT_SHARES_H

#include "film/aovs.h"
#include "shared/columns.h"

#if ONDE_TRAIL

// Shares of some light by what the first surface did: all that is not diffuse nor transmitted is
// glossy.
typedef struct {
    real3 diffuse;
    real transmitted; // 0 or 1
} LightShares;

INLINE LightShares no_shares(void) {
    LightShares none;
    none.diffuse = zero3();
    none.transmitted = (real)(0.0f);
    return none;
}

// The AOVs of light that `surfaces` surfaces have turned: 0 where the camera sees its source.
INLINE Aovs light_aovs(real3 value, uint surfaces, LightShares shares) {
    Aovs all = no_aovs();
    if (surfaces == 0) {
        all.emission = value;
        return all;
    }
    if (surfaces == 1) all.direct = value;
    if (surfaces > 1) all.indirect = value;
    const mask through = shares.transmitted > 0.0f;
    all.transmitted = choose(through, value, zero3());
    all.diffuse = choose(through, zero3(), mul3(value, shares.diffuse));
    all.glossy = choose(through, zero3(), sub3(value, all.diffuse));
    return all;
}

// The same of the light of one path, of the AOV of a number.
INLINE float3 light_aov(uint aov, float3 value, uint surfaces, float3 diffuse, float transmitted) {
    const bool through = transmitted > 0.0f;
    const float3 none = (float3)(0.0f);
    switch (aov) {
    case AOV_EMISSION:
        return surfaces == 0 ? value : none;
    case AOV_DIRECT:
        return surfaces == 1 ? value : none;
    case AOV_INDIRECT:
        return surfaces > 1 ? value : none;
    case AOV_TRANSMITTED:
        return through && surfaces > 0 ? value : none;
    case AOV_DIFFUSE:
        return through || surfaces == 0 ? none : value * diffuse;
    case AOV_GLOSSY:
        return through || surfaces == 0 ? none : value - value * diffuse;
    }
    return none;
}

#endif

#endif
