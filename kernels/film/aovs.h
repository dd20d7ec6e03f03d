// Planes of a film, and of the sums of a wave's paths, behind those of radiance: one for each AOV
// that the program has, in the order of the list.
#ifndef ONDE_FILM_AOVS_H
#define ONDE_FILM_AOVS_H

#include "math/vector.h"
#include "shared/aovs.h"

#ifndef ONDE_AOVS
    #define ONDE_AOVS 0
#endif

#define HAS_AOV(NAME) (ONDE_AOVS >> AOV_##NAME & 1)

// Bits of a constant, as a constant.
#define ONDE_BIT(NAME, name, components) +(ONDE_AOVS >> AOV_##NAME & 1)
#define AOV_PLANES (0 AOVS(ONDE_BIT))

#if ONDE_AOVS

typedef struct {
    #define ONDE_AOV_MEMBER(NAME, name, components) real3 name;
    AOVS(ONDE_AOV_MEMBER)
    #undef ONDE_AOV_MEMBER
} Aovs;

INLINE Aovs no_aovs(void) {
    Aovs none;
    #define ONDE_NO_AOV(NAME, name, components) none.name = zero3();
    AOVS(ONDE_NO_AOV)
    #undef ONDE_NO_AOV
    return none;
}

#endif

#endif
