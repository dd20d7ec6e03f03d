// The scene as the kernels see it: pointers to read-only buffers, passed by value.
#ifndef ONDE_SHADE_SCENE_VIEW_H
#define ONDE_SHADE_SCENE_VIEW_H

#include "shared/frame.h"
#include "shared/scene.h"
#include "trace/bvh_view.h"

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
// Bits MATERIAL_... and LIGHT_...
#ifndef ONDE_KINDS
    #define ONDE_KINDS 0xffffffffu
#endif
#ifndef ONDE_LIGHTS
    #define ONDE_LIGHTS 0xffffffffu
#endif

#define VIEW_MEMBER(Type, name, words) __global const Type* name;
typedef struct {
    __global const FrameRecord* frame;
    BvhView bvh;
    SCENE_BUFFERS(VIEW_MEMBER)
} SceneView;

// The same as kernel parameters, in the order in which the host binds them.
#define BVH_PARAMETER(Type, name, words) __global const Type *bvh_##name,
#define SCENE_PARAMETER(Type, name, words) , __global const Type* name
#define SCENE_PARAMETERS                                                                           \
    __global const FrameRecord *frame,                                                             \
        BVH_BUFFERS(BVH_PARAMETER) uint bvh_root SCENE_BUFFERS(SCENE_PARAMETER)

// Declares the view and fills it from those parameters.
#define BVH_ARGUMENT(Type, name, words) bvh_##name,
#define SCENE_ARGUMENT(Type, name, words) , name
#define SCENE_VIEW(view)                                                                           \
    const SceneView view = {frame,                                                                 \
                            {BVH_BUFFERS(BVH_ARGUMENT) bvh_root} SCENE_BUFFERS(SCENE_ARGUMENT)}

#endif
