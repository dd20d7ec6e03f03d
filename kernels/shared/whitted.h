// What the Whitted estimator needs beside the scene: its settings, Phong materials, sources. See
// docs/whitted.md for the meaning of every number.
#ifndef ONDE_SHARED_WHITTED_H
#define ONDE_SHARED_WHITTED_H

#include "shared/types.h"

#define MAX_WAVELENGTHS 16
#define MAX_TREE_DEPTH 255

// A ray's kind: which wavelength it has (0: white, else 1 + index), and whether its factor is
// that of the surface it meets.
#define KIND_WAVELENGTH 0xffu
#define KIND_TAKES_FACTOR 0x100u

typedef struct {
    float ambient[3];
    uint has_background; // 0: a miss sees the environment
    float background[3];
    float epsilon;
    uint saturate, source_reflectivity, distance_falloff, fresnel;
    uint max_depth; // levels of the tree; the camera ray is the first
    uint source_count;
    uint wavelengths;
    uint pad;
    float bend[MAX_WAVELENGTHS]; // 1 / w^2 - 1 / w_d^2, per square micrometre
    float filter[3 * MAX_WAVELENGTHS];
} WhittedRecord;

// 48 bytes, one per material. The index at wavelength j is ior + dispersion * bend[j].
typedef struct {
    float color[3];
    uint texture; // of the colour, or NO_INDEX
    float ambient, diffuse, specular, exponent;
    float reflection, transmission;
    float ior, dispersion;
} PhongRecord;

#define SOURCE_RECTANGLE 0u
#define SOURCE_DISK 1u
#define SOURCE_SPHERE 2u
#define SOURCE_POINT 3u
#define SOURCE_DIRECTIONAL 4u

// 64 bytes. Position of a directional source: the unit vector to it.
typedef struct {
    float position[3];
    uint kind;
    float edge1[3];
    float radius;
    float edge2[3];
    uint two_sided;
    float intensity[3];
    uint samples; // side of the grid of samples
} SourceRecord;

#endif
