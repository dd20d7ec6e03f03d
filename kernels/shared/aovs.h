// What a film may hold of a pixel beside radiance, each once: AOV(NAME, name, word, letters,
// SOURCE). Of each sample it is what kernels/path says, and 0 where there is nothing; the film has
// the mean. A program has only those that a render asks for, ONDE_AOVS by the bits of their
// numbers. The sources, in whose order they stand here:
//   SURFACE  the first surface of the path
//   RAY      what the camera's ray meets, be it a surface or nothing
//   GUIDE    the first one that is not a mirror or smooth glass
//   LIGHT    a share of the radiance
//   SAMPLE   a function of the whole sample's radiance
#ifndef ONDE_SHARED_AOVS_H
#define ONDE_SHARED_AOVS_H

#define AOVS(AOV)                                                                                  \
    AOV(ALPHA, alpha, "alpha", "A", SURFACE)                                                       \
    AOV(ALBEDO, albedo, "albedo", "RGB", SURFACE)                                                  \
    AOV(NORMAL, normal, "normal", "XYZ", SURFACE)                                                  \
    AOV(DEPTH, depth, "depth", "Z", SURFACE)                                                       \
    AOV(POSITION, position, "position", "XYZ", SURFACE)                                            \
    AOV(UV, uv, "uv", "UV", SURFACE)                                                               \
    AOV(MOTION, motion, "motion", "uv", RAY)                                                       \
    AOV(DENOISE_ALBEDO, denoise_albedo, "denoise-albedo", "RGB", GUIDE)                            \
    AOV(DENOISE_NORMAL, denoise_normal, "denoise-normal", "XYZ", GUIDE)                            \
    AOV(EMISSION, emission, "emission", "RGB", LIGHT)                                              \
    AOV(DIRECT, direct, "direct", "RGB", LIGHT)                                                    \
    AOV(INDIRECT, indirect, "indirect", "RGB", LIGHT)                                              \
    AOV(DIFFUSE, diffuse, "diffuse", "RGB", LIGHT)                                                 \
    AOV(GLOSSY, glossy, "glossy", "RGB", LIGHT)                                                    \
    AOV(TRANSMITTED, transmitted, "transmitted", "RGB", LIGHT)                                     \
    AOV(SQUARES, squares, "variance", "RGB", SAMPLE)                                               \
    AOV(CLAMPED, clamped, "clamped", "RGB", SAMPLE)                                                \
    AOV(HALVES, halves, "error", "RGB", SAMPLE)

// Of the samples of a block, those whose numbers have this bit are its second half, whose sum
// HALVES is.
#define HALF_BLOCK 32u

#define AOV_NUMBER(NAME, name, word, letters, SOURCE) AOV_##NAME,
enum { AOVS(AOV_NUMBER) AOV_COUNT };

#define AOV_SOURCE_SURFACE 0
#define AOV_SOURCE_RAY 1
#define AOV_SOURCE_GUIDE 2
#define AOV_SOURCE_LIGHT 3
#define AOV_SOURCE_SAMPLE 4

// Bits of the AOVs of a source.
#define ONDE_SURFACE_BIT(NAME, name, word, letters, SOURCE)                                        \
    +((unsigned)(AOV_SOURCE_##SOURCE == AOV_SOURCE_SURFACE) << AOV_##NAME)
#define ONDE_GUIDE_BIT(NAME, name, word, letters, SOURCE)                                          \
    +((unsigned)(AOV_SOURCE_##SOURCE == AOV_SOURCE_GUIDE) << AOV_##NAME)
#define ONDE_LIGHT_BIT(NAME, name, word, letters, SOURCE)                                          \
    +((unsigned)(AOV_SOURCE_##SOURCE == AOV_SOURCE_LIGHT) << AOV_##NAME)
#define ONDE_SAMPLE_BIT(NAME, name, word, letters, SOURCE)                                         \
    +((unsigned)(AOV_SOURCE_##SOURCE == AOV_SOURCE_SAMPLE) << AOV_##NAME)
#define SURFACE_AOVS (0u AOVS(ONDE_SURFACE_BIT))
#define GUIDE_AOVS (0u AOVS(ONDE_GUIDE_BIT))
#define LIGHT_AOVS (0u AOVS(ONDE_LIGHT_BIT))
#define SAMPLE_AOVS (0u AOVS(ONDE_SAMPLE_BIT))

#endif
