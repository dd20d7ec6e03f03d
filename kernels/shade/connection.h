// What a vertex may add to a sum, if nothing is in the way: a ray, its value and its target.
#ifndef ONDE_SHADE_CONNECTION_H
#define ONDE_SHADE_CONNECTION_H

#include "trace/columns.h"

typedef struct {
    real3 origin, direction;
    real distance;  // 0: nothing to test and nothing to add
    real3 value;    // is added, times the transmittance of the way
    natural target; // y * width + x of a pixel; or where all is for the path's own sum, the group
                    // of the light
#if ONDE_WAYS
    natural way; // see shade/media.h
#endif
#if ONDE_TRAIL
    real3 diffuse; // shares of the value
    real transmitted;
#endif
} Connection;

INLINE Connection no_connection(void) {
    Connection c;
    c.origin = c.direction = c.value = zero3();
    c.distance = (real)(0.0f);
    c.target = (natural)(0u);
#if ONDE_WAYS
    c.way = (natural)(0u);
#endif
#if ONDE_TRAIL
    c.diffuse = zero3();
    c.transmitted = (real)(0.0f);
#endif
    return c;
}

#if ONDE_WAYS
    #define CONNECTION_WAYS WAY_COLUMNS
#else
    #define CONNECTION_WAYS NO_COLUMNS
#endif
#if ONDE_TRAIL
    #define CONNECTION_SHARES SHARE_COLUMNS
#else
    #define CONNECTION_SHARES NO_COLUMNS
#endif
#define CONNECTION_MEMBERS(VECTOR, REAL, NATURAL)                                                  \
    SPLAT_COLUMNS(VECTOR, REAL, NATURAL)                                                           \
    CONNECTION_WAYS(VECTOR, REAL, NATURAL) CONNECTION_SHARES(VECTOR, REAL, NATURAL)
COLUMNS_CHOICE(Connection, CONNECTION_MEMBERS)

#endif
