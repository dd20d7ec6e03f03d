// The scene as the kernels see it: pointers to read-only buffers, passed by value.
#ifndef ONDE_SHADE_SCENE_VIEW_H
#define ONDE_SHADE_SCENE_VIEW_H

#include "shared/frame.h"
#include "shared/motion.h"
#include "shared/scene.h"
#include "trace/bvh_view.h"

// What the scene needs; the host compiles only that.
#ifndef ONDE_TEXTURES
    #define ONDE_TEXTURES 1
#endif
// Whether texture coordinates are asked for whatever textures there are.
#ifndef ONDE_UV
    #define ONDE_UV 0
#endif
// Whether some triangle's corners have other normals than the triangle itself.
#ifndef ONDE_CURVED
    #define ONDE_CURVED 1
#endif
#ifndef ONDE_NORMAL_MAPS
    #define ONDE_NORMAL_MAPS 1
#endif
// Sets of texture coordinates that its textures use; whether some texture moves, turns or scales
// them, whether some takes the nearest texel, and whether some has samples of 16 bits.
#ifndef ONDE_UV_SETS
    #define ONDE_UV_SETS 1
#endif
#ifndef ONDE_TEXTURE_TRANSFORMS
    #define ONDE_TEXTURE_TRANSFORMS 0
#endif
#ifndef ONDE_NEAREST_FILTERS
    #define ONDE_NEAREST_FILTERS 0
#endif
#ifndef ONDE_WIDE_TEXTURES
    #define ONDE_WIDE_TEXTURES 0
#endif
// Whether some material lets rays pass by its alpha, and whether cameras see through the back of
// some. ONDE_PASSING is 1 where rays or light may go on behind a surface for these reasons or
// others.
#ifndef ONDE_ALPHA
    #define ONDE_ALPHA 0
#endif
#ifndef ONDE_CULLING
    #define ONDE_CULLING 0
#endif
#define ONDE_SEEN_THROUGH (ONDE_ALPHA || ONDE_CULLING)
#ifndef ONDE_VERTEX_COLORS
    #define ONDE_VERTEX_COLORS 0
#endif
#ifndef ONDE_ENVIRONMENT
    #define ONDE_ENVIRONMENT 1
#endif
// Whether the scene has a light tree.
#ifndef ONDE_LIGHT_TREE
    #define ONDE_LIGHT_TREE 0
#endif
// Whether it is known where things are at the next frame.
#ifndef ONDE_MOTION
    #define ONDE_MOTION 0
#endif
#if ONDE_MOTION
    #define NEXT_FRAME_BUFFERS MOTION_BUFFERS
#else
    #define NEXT_FRAME_BUFFERS(BUFFER)
#endif
// Whether some material has microfacets, whether some solid glass does, and whether some asks what
// they reflect in all.
#ifndef ONDE_ROUGH
    #define ONDE_ROUGH 1
#endif
#ifndef ONDE_ROUGH_GLASS
    #define ONDE_ROUGH_GLASS 1
#endif
#ifndef ONDE_ALBEDOS
    #define ONDE_ALBEDOS 1
#endif
// Whether coats have other indices than 1.5, whether their bodies may be clear, whether solids
// absorb light; whether light goes straight through some smooth thin wall, and through smooth
// solids where no other way would find it.
#ifndef ONDE_INDICES
    #define ONDE_INDICES 1
#endif
#ifndef ONDE_TRANSMISSION
    #define ONDE_TRANSMISSION 1
#endif
// Whether some microfacets have a grain, and whether some solid bends light by its wavelength.
#ifndef ONDE_ANISOTROPY
    #define ONDE_ANISOTROPY 0
#endif
#ifndef ONDE_DISPERSION
    #define ONDE_DISPERSION 0
#endif
// Whether metals' edges have a tint, coats send light back to their bodies, and some surfaces are
// blends of two materials.
#ifndef ONDE_EDGES
    #define ONDE_EDGES 0
#endif
#ifndef ONDE_INNER
    #define ONDE_INNER 0
#endif
#ifndef ONDE_BLENDS
    #define ONDE_BLENDS 0
#endif
#ifndef ONDE_ABSORPTION
    #define ONDE_ABSORPTION 0
#endif
// Whether light meets media on its way; they do what solids absorb, too.
#ifndef ONDE_MEDIA
    #define ONDE_MEDIA 0
#endif
#if ONDE_MEDIA
    #undef ONDE_ABSORPTION
    #define ONDE_ABSORPTION 0
#endif
// Whether some medium glows, and whether some is not as dense everywhere.
#if !ONDE_MEDIA
    #undef ONDE_GLOW
    #undef ONDE_GRIDS
#endif
#ifndef ONDE_GLOW
    #define ONDE_GLOW 0
#endif
#ifndef ONDE_GRIDS
    #define ONDE_GRIDS 0
#endif
#define ONDE_STRAIGHT (ONDE_PANES || ONDE_UNBENT || ONDE_MEDIA)
// Whether connections say how they go.
#define ONDE_WAYS (ONDE_UNBENT || ONDE_MEDIA)
// Bits LOBE_..., of what some material has and of what all have; MATERIAL_... and LIGHT_...
#ifndef ONDE_LOBES
    #define ONDE_LOBES 0xffffffffu
#endif
#ifndef ONDE_COMMON_LOBES
    #define ONDE_COMMON_LOBES 0u
#endif
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
    NEXT_FRAME_BUFFERS(VIEW_MEMBER)
} SceneView;

// The same as kernel parameters, in the order in which the host binds them.
#define BVH_PARAMETER(Type, name, words) __global const Type *bvh_##name,
#define SCENE_PARAMETER(Type, name, words) , __global const Type* name
#define SCENE_PARAMETERS                                                                           \
    __global const FrameRecord *frame,                                                             \
        BVH_BUFFERS(BVH_PARAMETER) uint bvh_root SCENE_BUFFERS(SCENE_PARAMETER)                    \
            NEXT_FRAME_BUFFERS(SCENE_PARAMETER)

// Declares the view and fills it from those parameters.
#define BVH_ARGUMENT(Type, name, words) bvh_##name,
#define SCENE_ARGUMENT(Type, name, words) , name
#define SCENE_VIEW(view)                                                                           \
    const SceneView view = {frame,                                                                 \
                            {BVH_BUFFERS(BVH_ARGUMENT) bvh_root} SCENE_BUFFERS(SCENE_ARGUMENT)     \
                                NEXT_FRAME_BUFFERS(SCENE_ARGUMENT)}

// A field of a surface's own record, a float or uint: SURFACE_FIELD(view, i, sphere.radius).
#define SURFACE_FIELD(view, i, field) RECORD(view.surfaces, i, SurfaceRecord, field)
#define SURFACE_NATURAL(view, i, field) RECORD_NATURAL(view.surfaces, i, SurfaceRecord, field)

#endif
