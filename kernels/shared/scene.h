// Materials, surfaces, lights and textures as they lie in device memory. Every record is an array
// of 32-bit words, because width-generic code gathers single words by lane.
#ifndef ONDE_SHARED_SCENE_H
#define ONDE_SHARED_SCENE_H

#include "shared/types.h"

#define NO_INDEX 0xffffffffu

#define MATERIAL_DIFFUSE 0u
#define MATERIAL_CONDUCTOR 1u
#define MATERIAL_DIELECTRIC 2u
#define MATERIAL_METALLIC_ROUGHNESS 3u

// Below this alpha (roughness^2) a surface is treated as perfectly smooth.
#define SMOOTH_ALPHA 1e-3f

// 64 bytes. See onde::Material for meanings; textures are NO_INDEX where there is none.
typedef struct {
    float base_color[3];
    uint kind;
    float emission[3];
    float roughness;
    float metallic;
    float ior;
    float normal_scale;
    uint two_sided;
    uint base_color_texture;
    uint metallic_roughness_texture;
    uint emission_texture;
    uint normal_texture;
} MaterialRecord;

#define LIGHT_UNLISTED 0xfffffffeu        // emits too little to be worth sampling; rays may find it
#define SURFACE_SPHERE 0x80000000u        // flag in SurfaceRecord.material
#define SURFACE_SHAPE 0x40000000u         // likewise; none of both: a triangle
#define SURFACE_FLAT 0x20000000u          // a triangle whose corner normals all are `geometric`
#define SURFACE_MATERIAL_MASK 0x1fffffffu // the index in it

// 64 bytes, one per primitive. Unit vectors are octahedral, 2 x 16 bits (see math/elementary.h).
// Triangle: corner normals, tangent, uvs and geometric normal in object space.
// Sphere: `geometric` holds the centre, `uv[0]` the radius; the rest is unused.
// Shape: `tangent` holds SHAPE_..., `uv[0]` the minor radius; the rest is unused.
typedef struct {
    uint normal[3];
    uint material; // index, with SURFACE_SPHERE, SURFACE_SHAPE or SURFACE_FLAT
    float uv[6];   // u0 v0 u1 v1 u2 v2
    float geometric[3];
    uint tangent; // octahedral with the lowest bit replaced by the sign of the bitangent
    uint light;   // index into the lights, NO_INDEX, or LIGHT_UNLISTED
    uint unused;
} SurfaceRecord;

#define LIGHT_TRIANGLE 0u
#define LIGHT_SPHERE 1u
#define LIGHT_POINT 2u
#define LIGHT_DIRECTIONAL 3u
#define LIGHT_ENVIRONMENT 4u
#define LIGHT_DISK 5u

// 80 bytes, in world space.
typedef struct {
    uint kind;
    float pmf;         // probability of being chosen
    float alias_below; // stay here when the choice's fraction is below, else take alias
    uint alias;
    float
        position[3]; // triangle: first corner; sphere, disk: centre; directional: unit vector to it
    float area;      // triangle, disk: area; sphere: radius
    float edge1[3];  // triangle: edges from the first corner; disk: two conjugate radii
    uint material;   // triangle, sphere: emitting material
    float edge2[3];
    uint surface;      // triangle: its SurfaceRecord
    float radiance[3]; // point: intensity; directional: irradiance
    float orientation; // triangle: +1, or -1 when the front face is on the other side of e1 x e2
} LightRecord;

#define WRAP_REPEAT 0u
#define WRAP_CLAMP 1u
#define WRAP_MIRROR 2u

// 32 bytes. Texels are RGBA8 words in one common buffer.
typedef struct {
    uint offset; // of the first texel
    uint width, height;
    uint wrap_u, wrap_v;
    uint unused[3];
} TextureRecord;

// 16 bytes, one per environment pixel: alias table for choosing a pixel by its power (Vose 1991).
typedef struct {
    float below; // stay when the fraction of the draw is below, else take alias
    uint alias;
    float pmf;
    uint unused;
} AliasRecord;

// The buffers of a scene beside its tree's, each once, as BVH_BUFFERS in shared/bvh.h.
// srgb: 256 entries, from 8-bit sRGB to linear. environment: 3 floats per pixel.
#define SCENE_BUFFERS(BUFFER)                                                                      \
    BUFFER(SurfaceRecord, surfaces, "surfaces")                                                    \
    BUFFER(MaterialRecord, materials, "materials")                                                 \
    BUFFER(LightRecord, lights, "lights")                                                          \
    BUFFER(TextureRecord, textures, "texture records")                                             \
    BUFFER(uint, texels, "texels")                                                                 \
    BUFFER(float, srgb, "sRGB table")                                                              \
    BUFFER(float, environment, "environment pixels")                                               \
    BUFFER(AliasRecord, environment_alias, "environment sampling")

#endif
