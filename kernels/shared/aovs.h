// What a film may hold of a pixel beside radiance, each once: AOV(NAME, name, components). Of each
// sample it is what kernels/path/aovs.h says of the first surface, and 0 where there is none; the
// film has the mean. A program has only those that a render asks for, ONDE_AOVS by the bits of
// their numbers.
#ifndef ONDE_SHARED_AOVS_H
#define ONDE_SHARED_AOVS_H

#define AOVS(AOV)                                                                                  \
    AOV(ALPHA, alpha, 1)                                                                           \
    AOV(ALBEDO, albedo, 3)                                                                         \
    AOV(NORMAL, normal, 3)                                                                         \
    AOV(DEPTH, depth, 1)

#define AOV_NUMBER(NAME, name, components) AOV_##NAME,
enum { AOVS(AOV_NUMBER) AOV_COUNT };

#endif
