// Planes of a film behind that of radiance: one for each AOV that the program has, in the order of
// the list, then one for each group of lights. The paths of a wave have planes for those that are
// not functions of their radiance.
#ifndef ONDE_FILM_AOVS_H
#define ONDE_FILM_AOVS_H

#include "math/vector.h"
#include "shared/aovs.h"
#include "shared/columns.h"

#ifndef ONDE_AOVS
    #define ONDE_AOVS 0
#endif

#define HAS_AOV(NAME) (ONDE_AOVS >> AOV_##NAME & 1)
#define HAS_AOVS_OF(SOURCE) ((ONDE_AOVS & SOURCE##_AOVS) != 0)

// Bits of a constant, as a constant.
#define ONDE_STORED_BIT(NAME, name, word, letters, SOURCE)                                         \
    +(AOV_SOURCE_##SOURCE != AOV_SOURCE_SAMPLE && (ONDE_AOVS >> AOV_##NAME & 1))
#define ONDE_AOV_BIT(NAME, name, word, letters, SOURCE) +(ONDE_AOVS >> AOV_##NAME & 1)
#define STORED_AOVS (0 AOVS(ONDE_STORED_BIT))
#define WAVE_PLANES (STORED_AOVS + ONDE_GROUPS)

// The first planes of groups.
#define WAVE_GROUPS (1 + STORED_AOVS)
#define FILM_GROUPS (1 AOVS(ONDE_AOV_BIT))

#if ONDE_AOVS

typedef struct {
    #define ONDE_AOV_MEMBER(NAME, name, word, letters, SOURCE) real3 name;
    AOVS(ONDE_AOV_MEMBER)
    #undef ONDE_AOV_MEMBER
} Aovs;

INLINE Aovs no_aovs(void) {
    Aovs none;
    #define ONDE_NO_AOV(NAME, name, word, letters, SOURCE) none.name = zero3();
    AOVS(ONDE_NO_AOV)
    #undef ONDE_NO_AOV
    return none;
}

// Functions of a sample's radiance. Beyond what floats can add up a square says nothing.
INLINE float4 sample_squares(float4 radiance) {
    const float4 held = fmin(radiance, (float4)(1e15f));
    return held * held;
}

#endif

#endif
