// What `onde inspect` learns from the device about one sample of one pixel.
#ifndef ONDE_SHARED_INSPECT_H
#define ONDE_SHARED_INSPECT_H

#include "shared/scene.h"
#include "shared/types.h"

// Where a ray ended. primitive is BVH_NONE on a miss, where the rest is 0.
typedef struct {
    float origin[3], direction[3];
    float t;
    uint primitive, instance;
    uint material;
    uint front;
    float position[3], normal[3];
} HitReport;

// A node of Whitted's ray tree. returned = own, and for each child its factor times its returned.
typedef struct {
    HitReport hit;
    uint parent; // index of a report, its own for the camera ray
    uint level;
    uint kind;       // as TreeRay.kind
    uint alive;      // 0: its product of factors is not above epsilon
    float factor[3]; // of its colour in its parent's
    float product;
    float emission[3], ambient[3];
    float own[3], returned[3];
} NodeReport;

// What one source adds to a node, before sums are cut at 1.
typedef struct {
    float visible; // the mean over its samples of what arrives, 0 to 1
    float diffuse[3], specular[3];
} SourceReport;

// A vertex of a path. throughput is that of the ray that came here.
typedef struct {
    HitReport hit;
    float throughput[3];
    float emitted[3]; // radiance found here, weighted
    uint light;       // sampled light, or NO_INDEX
    float light_pdf;  // per solid angle, with the choice of the light; the choice alone for deltas
    float light_direction[3];
    float light_distance;    // of the shadow ray; 0: none was needed
    float light_radiance[3]; // what it adds if it is not blocked, weighted
    uint blocked;
    uint lobes;                    // a bit for each that the surface has; of others nothing is said
    float probability[LOBE_COUNT]; // of choosing a lobe
    float diffuse[3], f0[3];
    float alpha, eta;
    float next_direction[3];
    float next_pdf; // 0 for a delta direction
    float next_throughput[3];
    uint alive; // whether the path goes on
} BounceReport;

#endif
