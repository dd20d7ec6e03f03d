// How many elements one work item of a kernel takes, where host and kernel must agree.
#ifndef ONDE_SHARED_ITEMS_H
#define ONDE_SHARED_ITEMS_H

#define PROBE_ITEMS 16  // of the tests' probes: a multiple of every width
#define VOLUME_ITEMS 16 // rays against bounding volumes
#define SOLVER_ITEMS 16 // systems of equations
#define LEAK_RAYS 64    // rays at the seams of a mesh

#endif
