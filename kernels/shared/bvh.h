// The acceleration structure as it lies in device memory, in one of three layouts: wide for the
// vectors of CPUs, compressed and binary for GPUs. Plain data for C++ and OpenCL C alike.
#ifndef ONDE_SHARED_BVH_H
#define ONDE_SHARED_BVH_H

#include "shared/types.h"

#define BVH_LAYOUT_WIDE 0       // BvhNode and TriangleBlock
#define BVH_LAYOUT_COMPRESSED 1 // BvhCompressed and BvhSlot
#define BVH_LAYOUT_BINARY 2     // BvhPair and BvhSlot

#define BVH_WIDTH 16         // children of a node
#define BVH_LEAF_WIDTH 8     // triangles of a leaf block
#define BVH_NONE 0xffffffffu // no primitive, no instance

// A child word: inner nodes are plain indices; leaves have the top bit and two bits of kind.
#define BVH_LEAF 0x80000000u
#define BVH_KIND_MASK 0xe0000000u
#define BVH_LEAF_TRIANGLES 0x80000000u // index of a TriangleBlock
#define BVH_LEAF_SPHERE 0xa0000000u    // index into the spheres
#define BVH_LEAF_INSTANCE 0xc0000000u  // index into the instances
// Index into the spheres, of one that is a canonical shape. BVH_NONE looks like this kind: compare
// with it first.
#define BVH_LEAF_SHAPE 0xe0000000u
#define BVH_INDEX_MASK 0x1fffffffu

// 512 bytes, of which 448 are used. Bounds by axis, low then high, so that the far plane of an axis
// is at the near plane's byte offset xor 64. An empty slot has low > high and is never entered.
typedef struct {
    float low_x[BVH_WIDTH], high_x[BVH_WIDTH];
    float low_y[BVH_WIDTH], high_y[BVH_WIDTH];
    float low_z[BVH_WIDTH], high_z[BVH_WIDTH];
    uint child[BVH_WIDTH];
    uint unused[BVH_WIDTH];
} BvhNode;

// 320 bytes: one vertex and two edges of up to 8 triangles, and their global primitive ids in
// ascending order; BVH_NONE marks an empty slot, whose triangle is degenerate. In a watertight tree
// e1 and e2 are the two other vertices: those that triangles share then have the same bits.
typedef struct {
    float v0_x[BVH_LEAF_WIDTH], v0_y[BVH_LEAF_WIDTH], v0_z[BVH_LEAF_WIDTH];
    float e1_x[BVH_LEAF_WIDTH], e1_y[BVH_LEAF_WIDTH], e1_z[BVH_LEAF_WIDTH];
    float e2_x[BVH_LEAF_WIDTH], e2_y[BVH_LEAF_WIDTH], e2_z[BVH_LEAF_WIDTH];
    uint primitive[BVH_LEAF_WIDTH];
} TriangleBlock;

#define COMPRESSED_WIDTH 8 // children of a compressed node
#define COMPRESSED_LEAF 3  // slots of a leaf below one
#define BINARY_LEAF 4      // slots of a leaf in the binary layout

// 80 bytes: a node in the manner of Ylitie, Karras and Laine, "Efficient incoherent ray traversal
// on GPUs through compressed wide BVHs", 2017. Plane q of an axis lies at origin + q 2^(exponent -
// 127); child boxes are rounded outward. Bit a of a slot's number says whether the child lies
// toward the high end of axis a, as far as that can be: a ray visits the slots in the order of
// their number xor the signs of its direction.
typedef struct {
    float origin[3];
    uchar exponent[3];
    uchar inner; // a bit for each slot that holds a node
    uint child;  // index of the first of those nodes; the others follow in the order of their slots
    uint slot;   // index of the first of the BvhSlots of all leaves below
    uchar leaf[COMPRESSED_WIDTH]; // of a leaf: count << 5 | first BvhSlot, from `slot`; else 0
    uchar low_x[COMPRESSED_WIDTH], high_x[COMPRESSED_WIDTH];
    uchar low_y[COMPRESSED_WIDTH], high_y[COMPRESSED_WIDTH];
    uchar low_z[COMPRESSED_WIDTH], high_z[COMPRESSED_WIDTH];
} BvhCompressed;

// 64 bytes: a node of the binary layout, with the boxes of both children. A child word is the index
// of a BvhPair; or of a leaf BVH_LEAF | (count - 1) << 29 | first BvhSlot; or of none, whose box is
// never entered, BVH_NONE.
typedef struct {
    float low_x[2], high_x[2];
    float low_y[2], high_y[2];
    float low_z[2], high_z[2];
    uint child[2];
    uint unused[2];
} BvhPair;

#define BINARY_COUNT_SHIFT 29

// 48 bytes: what a leaf of the compressed or binary layout holds; `kind` is that of a child word. A
// triangle as in TriangleBlock; of anything else, `primitive` is its index in its own array.
typedef struct {
    float v0[3];
    uint kind;
    float e1[3];
    uint primitive;
    float e2[3];
    uint unused;
} BvhSlot;

#define SHAPE_ELLIPSOID 0u
#define SHAPE_DISK 1u
#define SHAPE_CYLINDER 2u
#define SHAPE_CONE 3u
#define SHAPE_TORUS 4u

// 32 bytes. A sphere primitive in the space of the tree that holds it; or, in leaves of shapes, one
// of the canonical shapes (see onde::Shape), where `radius` is the torus's minor one.
typedef struct {
    float center[3];
    float radius;
    uint primitive;
    uint kind; // SHAPE_...; BVH_NONE of spheres
    uint unused[2];
} BvhSphere;

// 128 bytes. Rows of the 3x4 matrices: x' = row . (x, y, z, 1). Behind the instances lie the keys
// of those that move, of which object_to_world counts.
typedef struct {
    float world_to_object[12];
    float object_to_world[12];
    uint root;   // child word of the instanced tree's root
    float scale; // by which a length of object space grows at most in the world
    uint steps;  // of its motion while the shutter is open; 0: it stands still
    uint keys;   // the first of steps + 1 instances, which are where it is at equal steps
    uint unused[4];
} BvhInstance;

// The buffers of a tree, each once: BUFFER(Type, name, "name for people"). From this list come the
// parameters and the view of the kernels, and on the host arrays, buffers, binding and memory plan.
// Of nodes and of leaves (`blocks`) there is one kind, which the layout names.
#define BVH_BUFFERS(BUFFER)                                                                        \
    BUFFER(uchar, nodes, "BVH nodes")                                                              \
    BUFFER(uchar, blocks, "BVH triangles")                                                         \
    BUFFER(BvhSphere, spheres, "BVH spheres and shapes")                                           \
    BUFFER(BvhInstance, instances, "BVH instances")

#endif
