// The scene as the kernels see it: pointers to read-only buffers, passed by value.
#ifndef ONDE_SHADE_SCENE_VIEW_H
#define ONDE_SHADE_SCENE_VIEW_H

#include "shared/frame.h"
#include "shared/scene.h"
#include "trace/bvh.h"

// What the scene needs; the host compiles only that.
#ifndef ONDE_TEXTURES
    #define ONDE_TEXTURES 1
#endif
#ifndef ONDE_NORMAL_MAPS
    #define ONDE_NORMAL_MAPS 1
#endif
#ifndef ONDE_ENVIRONMENT
    #define ONDE_ENVIRONMENT 1
#endif

typedef struct {
    __global const FrameRecord* frame;
    BvhView bvh;
    __global const SurfaceRecord* surfaces;
    __global const MaterialRecord* materials;
    __global const LightRecord* lights;
    __global const TextureRecord* textures;
    __global const uint* texels;
    __global const float* srgb;        // 256 entries: 8-bit sRGB to linear
    __global const float* environment; // 3 floats per pixel
    __global const AliasRecord* environment_alias;
} SceneView;

// The same as kernel parameters, in the order in which the host binds them.
#define SCENE_PARAMETERS                                                                           \
    __global const FrameRecord *frame, __global const uchar *bvh_nodes,                            \
        __global const uchar *bvh_blocks, __global const BvhSphere *bvh_spheres,                   \
        __global const BvhInstance *bvh_instances, uint bvh_root,                                  \
        __global const SurfaceRecord *surfaces, __global const MaterialRecord *materials,          \
        __global const LightRecord *lights, __global const TextureRecord *textures,                \
        __global const uint *texels, __global const float *srgb,                                   \
        __global const float *environment, __global const AliasRecord *environment_alias

#define SCENE_VIEW(view)                                                                           \
    SceneView view;                                                                                \
    view.frame = frame;                                                                            \
    view.bvh.nodes = bvh_nodes;                                                                    \
    view.bvh.blocks = bvh_blocks;                                                                  \
    view.bvh.spheres = bvh_spheres;                                                                \
    view.bvh.instances = bvh_instances;                                                            \
    view.bvh.root = bvh_root;                                                                      \
    view.surfaces = surfaces;                                                                      \
    view.materials = materials;                                                                    \
    view.lights = lights;                                                                          \
    view.textures = textures;                                                                      \
    view.texels = texels;                                                                          \
    view.srgb = srgb;                                                                              \
    view.environment = environment;                                                                \
    view.environment_alias = environment_alias

#endif
