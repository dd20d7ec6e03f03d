// Materials, surfaces, lights and textures as they lie in device memory. Every record is an array
// of 32-bit words, because width-generic code gathers single words by lane.
#ifndef ONDE_SHARED_SCENE_H
#define ONDE_SHARED_SCENE_H

#include "shared/spectrum.h"
#include "shared/types.h"

#define NO_INDEX 0xffffffffu

#define MATERIAL_DIFFUSE 0u
#define MATERIAL_CONDUCTOR 1u
#define MATERIAL_DIELECTRIC 2u
#define MATERIAL_METALLIC_ROUGHNESS 3u
#define MATERIAL_UNLIT 4u // shows its base colour, whatever the light; has no lobe
#define MATERIAL_KIND_COUNT 5u

// The lobes that a BSDF is the sum of, each once: LOBE(NAME, name, Type, transmits). `name` has a
// file kernels/shade/lobes/name.h with its Type; `transmits` says whether light may pass the
// surface. What lies on top comes first. Which ones a material has is told by lobes_of() in
// src/upload/appearance.h; what no material of a scene has is not compiled.
#define LOBES(LOBE)                                                                                \
    LOBE(COAT, coat, CoatLobe, 0)                                                                  \
    LOBE(SHEEN, sheen, SheenLobe, 0)                                                               \
    LOBE(DIFFUSE, diffuse, DiffuseLobe, 0)                                                         \
    LOBE(BEHIND, behind, BehindLobe, 1)                                                            \
    LOBE(GLOSSY, glossy, GlossyLobe, 0)                                                            \
    LOBE(DIELECTRIC, dielectric, DielectricLobe, 1)                                                \
    LOBE(THIN, thin, ThinLobe, 1)
#define LOBE_INDEX(NAME, name, Type, transmits) LOBE_##NAME,
enum { LOBES(LOBE_INDEX) LOBE_COUNT };

// Below this alpha (roughness^2) a surface is treated as perfectly smooth.
#define SMOOTH_ALPHA 1e-3f

// What the kernels know of a material, each once, by the names of onde::Material's members:
// colours, numbers, textures (SLOT(NAME, name) stands for name_texture).
#define MATERIAL_COLORS(COLOR)                                                                     \
    COLOR(base_color)                                                                              \
    COLOR(edge_tint)                                                                               \
    COLOR(emission) COLOR(specular_color) COLOR(diffuse_transmission_color) COLOR(sheen_color)
#define MATERIAL_NUMBERS(NUMBER)                                                                   \
    NUMBER(roughness)                                                                              \
    NUMBER(metallic)                                                                               \
    NUMBER(ior)                                                                                    \
    NUMBER(specular)                                                                               \
    NUMBER(transmission)                                                                           \
    NUMBER(diffuse_transmission)                                                                   \
    NUMBER(clearcoat)                                                                              \
    NUMBER(clearcoat_roughness)                                                                    \
    NUMBER(clearcoat_normal_scale)                                                                 \
    NUMBER(sheen_roughness)                                                                        \
    NUMBER(iridescence)                                                                            \
    NUMBER(iridescence_ior)                                                                        \
    NUMBER(iridescence_thickness)                                                                  \
    NUMBER(iridescence_thickness_minimum)                                                          \
    NUMBER(anisotropy)                                                                             \
    NUMBER(inner_reflection)                                                                       \
    NUMBER(blend)                                                                                  \
    NUMBER(dispersion)                                                                             \
    NUMBER(normal_scale) NUMBER(alpha) NUMBER(alpha_cutoff)
#define TEXTURE_SLOTS(SLOT)                                                                        \
    SLOT(BASE_COLOR, base_color)                                                                   \
    SLOT(METALLIC_ROUGHNESS, metallic_roughness)                                                   \
    SLOT(EMISSION, emission)                                                                       \
    SLOT(SPECULAR, specular)                                                                       \
    SLOT(SPECULAR_COLOR, specular_color)                                                           \
    SLOT(TRANSMISSION, transmission)                                                               \
    SLOT(DIFFUSE_TRANSMISSION, diffuse_transmission)                                               \
    SLOT(DIFFUSE_TRANSMISSION_COLOR, diffuse_transmission_color)                                   \
    SLOT(CLEARCOAT, clearcoat)                                                                     \
    SLOT(CLEARCOAT_ROUGHNESS, clearcoat_roughness)                                                 \
    SLOT(CLEARCOAT_NORMAL, clearcoat_normal)                                                       \
    SLOT(SHEEN_COLOR, sheen_color)                                                                 \
    SLOT(SHEEN_ROUGHNESS, sheen_roughness)                                                         \
    SLOT(IRIDESCENCE, iridescence)                                                                 \
    SLOT(IRIDESCENCE_THICKNESS, iridescence_thickness)                                             \
    SLOT(ANISOTROPY, anisotropy)                                                                   \
    SLOT(BLEND, blend)                                                                             \
    SLOT(NORMAL, normal)

#define TEXTURE_INDEX(NAME, name) TEXTURE_##NAME,
enum { TEXTURE_SLOTS(TEXTURE_INDEX) TEXTURE_COUNT };

// What a surface's alpha does.
#define ALPHA_OPAQUE 0u // nothing
#define ALPHA_MASK 1u   // rays pass where it is below the cutoff
#define ALPHA_BLEND 2u  // rays pass with probability 1 - alpha

// See onde::Material for meanings.
#define COLOR_MEMBER(name) float name[3];
#define NUMBER_MEMBER(name) float name;
typedef struct {
    uint kind;
    uint lobes; // bits by LOBE_...
    uint two_sided;
    uint alpha_mode;     // ALPHA_...
    uint double_sided;   // else camera rays pass its back
    uint group;          // of lights, that its emission belongs to
    uint albedos;        // of rough glass: the first word of its table of directional albedos
    uint other;          // the material that it is blended with, or NO_INDEX
    uint beckmann;       // whether its microfacets are distributed as Beckmann's
    uint blocks;         // whether it, smooth glass, blocks light that only straight ways reach
    uint medium;         // inside of it: index of a MediumRecord, or NO_INDEX where nothing is
    float absorption[3]; // inside of it: halvings per unit of length
    float grain[2];      // cosine and sine of anisotropy_rotation
    MATERIAL_COLORS(COLOR_MEMBER)
    MATERIAL_NUMBERS(NUMBER_MEMBER)
    uint texture[TEXTURE_COUNT]; // by slot: index of a TextureRecord, or NO_INDEX
} MaterialRecord;

// What absorbs and scatters light, and glows: rates per unit of length; where a grid says how dense
// it is, at density 1.
typedef struct {
    float extinction[3]; // by both
    float scattering[3];
    float emission[3]; // of radiance
    float anisotropy;  // of Henyey and Greenstein's phase function
    uint grid;         // index of a GridRecord, or NO_INDEX: it is the same everywhere
    uint unused;
} MediumRecord;
#define MEDIUM_AROUND 0u // the index of what is outside of all; behind it those inside of materials
#define MOST_MEDIA 0x7fffu

// Where a grid lies, and its densities: samples at whole coordinates, linear in between. They stand
// in bricks of 8 x 8 x 8 cells, each with all the samples at the corners of its cells. `bricks` is
// the first word of the table of bricks, x fastest: BRICK_WORDS each, the largest density in it as
// a float, and its first sample's word, or NO_INDEX where all of it has that density. The word of a
// sample and the next ones along x are neighbours, along y BRICK_ROW apart, along z BRICK_LAYER: it
// has the sample in its lower half and the next one along x in its upper, as shares of the largest.
typedef struct {
    float to_samples[12];  // from the world: rows
    float low[3], high[3]; // in samples: the density is 0 outside
    float scale;           // of densities
    uint bricks;
    uint table[3]; // its size
    uint unused;
} GridRecord;
#define BRICK_CELLS 8u
#define BRICK_WORDS 2u
#define BRICK_ROW BRICK_CELLS
#define BRICK_LAYER (BRICK_ROW * (BRICK_CELLS + 1u))
#define WORDS_OF_BRICK (BRICK_LAYER * (BRICK_CELLS + 1u))

#define LIGHT_UNLISTED 0xfffffffeu // emits too little to be worth sampling; rays may find it

// A surface's tag: what it is, of a triangle also its reach, and the index of its material. The
// reach is a length whose rounding bounds that of a hit's distance to the triangle's plane, a power
// of two of which the tag has the float's exponent.
#define SURFACE_SPHERE 0x80000000u
#define SURFACE_SHAPE 0x40000000u // neither: a triangle
#define SURFACE_FLAT 0x20000000u  // a triangle whose corner normals all are `geometric`
#define SURFACE_REACH_BITS(tag) (((tag) << 2) & 0x7f800000u) // as a float's
#define SURFACE_REACH(exponent) ((exponent) << 21)
#define SURFACE_MATERIAL(tag) ((tag)&0x1fffffu)
#define MOST_MATERIALS 0x200000u

// The corner of a triangle. Unit vectors are octahedral, 2 x 16 bits (see math/elementary.h).
typedef struct {
    uint normal; // in object space
    float uv[2];
} VertexRecord;

// 36 bytes, one per primitive. `light`: index into the lights, NO_INDEX, or LIGHT_UNLISTED.
typedef struct {
    uint tag, light;
} AnySurface;
typedef struct {
    uint tag, light;
    uint vertex[3];     // indices of VertexRecords
    float geometric[3]; // unit normal in object space
    float plane;        // dot product of that normal with the triangle's points
} TriangleSurface;
typedef struct {
    uint tag, light;
    float center[3]; // in the world
    float radius;
    uint unused[3];
} SphereSurface;
typedef struct {
    uint tag, light;
    uint shape; // SHAPE_...
    float minor_radius;
    uint unused[5];
} ShapeSurface;
typedef union {
    AnySurface any;
    TriangleSurface triangle;
    SphereSurface sphere;
    ShapeSurface shape;
} SurfaceRecord;

// What a light of each type has, in world space. Floats only: lanes of other types read them too,
// and what indexes something stands in LightRecord.
typedef struct {
    float corner[3];
    float area;
    float edge1[3], edge2[3]; // from the corner
    float orientation;        // +1, or -1 when the front face is on the other side of e1 x e2
} TriangleLightRecord;
typedef struct {
    float center[3];
    float area;
    float radius1[3], radius2[3]; // conjugate radii
    float orientation;            // as a triangle's
} DiskLightRecord;
typedef struct {
    float center[3];
    float radius;
} SphereLightRecord;
typedef struct {
    float position[3];
    float intensity[3];
} PointLightRecord;
typedef struct {
    float position[3];
    float back[3]; // unit, against the way it shines
    float intensity[3];
    float opening;   // 1 - cosine of the half angle
    float steepness; // of the way to full intensity, by cosine
} SpotLightRecord;
typedef struct {
    float to_light[3]; // unit
    float irradiance[3];
} DirectionalLightRecord;
typedef struct {
    float unused; // what it is stands in the frame
} EnvironmentLightRecord;

// The types of light, each once: LIGHT(NAME, name, Record). `name` has a file
// kernels/shade/lights/name.h; types that a scene does not have are not compiled.
#define LIGHT_TYPES(LIGHT)                                                                         \
    LIGHT(TRIANGLE, triangle, TriangleLightRecord)                                                 \
    LIGHT(SPHERE, sphere, SphereLightRecord)                                                       \
    LIGHT(DISK, disk, DiskLightRecord)                                                             \
    LIGHT(POINT, point, PointLightRecord)                                                          \
    LIGHT(SPOT, spot, SpotLightRecord)                                                             \
    LIGHT(DIRECTIONAL, directional, DirectionalLightRecord)                                        \
    LIGHT(ENVIRONMENT, environment, EnvironmentLightRecord)
#define LIGHT_INDEX(NAME, name, Record) LIGHT_##NAME,
enum { LIGHT_TYPES(LIGHT_INDEX) LIGHT_TYPE_COUNT };

#define LIGHT_RECORD(NAME, name, Record) Record name;
typedef struct {
    uint kind;         // LIGHT_...
    float pmf;         // probability of being chosen
    float alias_below; // stay here when the choice's fraction is below, else take alias
    uint alias;
    uint material; // that emits; 0 where the light has no surface
    uint surface;  // its SurfaceRecord; likewise
    uint group;    // of lights
    uint trail;    // to its leaf in the light tree, see there
    union {
        LIGHT_TYPES(LIGHT_RECORD)
    } as;
} LightRecord;

// The light tree is a list of pairs of branches: those of the root, of which every light is below
// one, then those of each branch that has more than one light. 48 bytes a branch: what bounds its
// lights, by which its importance to a point is judged (Conty Estevez and Kulla 2018, Importance
// Sampling of Many Lights with Adaptive Tree Splitting).
typedef struct {
    float center[3];
    float radius;  // of a sphere around them; negative: their power is their importance everywhere
    float axis[3]; // unit; their normals lie in a cone about it
    float spread;  // the cosine of the cone's half angle
    float reach;   // the cosine of the angle to their normals beyond which they send nothing
    float power;   // a share of that of all lights
    uint next;     // the first of the pair below, or LIGHT_LEAF and the index of the one light
    uint unused;
} LightBranch;
#define LIGHT_LEAF 0x80000000u

// A light's trail: by bits from the lowest, which branch of each pair from the root on it is below.
#define MOST_LIGHT_LEVELS 32u

#define WRAP_REPEAT 0u
#define WRAP_CLAMP 1u
#define WRAP_MIRROR 2u
#define FILTER_LINEAR 0u
#define FILTER_NEAREST 1u

// 64 bytes, one for each way of using a picture. Texels are RGBA8 words in one common buffer, where
// several records may name the same ones. Samples of 16 bits lie in two such pictures, of their
// higher and of their lower bytes; those of 8 bits have both in the same place, as 257 times a byte
// is that byte twice.
typedef struct {
    uint offset; // of the first texel
    uint low;    // of the first texel's lower bytes
    uint width, height;
    uint wrap_u, wrap_v;
    uint filter;      // FILTER_...
    uint uv_set;      // which of the packed sets of texture coordinates
    float u[3], v[3]; // rows of the matrix from those coordinates, (x, y, 1), to the texture's
    uint unused[2];
} TextureRecord;

// An entry of an alias table (Vose 1991). The environment has two for each pixel: of tables that
// choose one by its whole power, and by what paths draw of it (see shade/environment.h).
typedef struct {
    float below; // stay when the fraction of the draw is below, else take alias
    uint alias;
} AliasRecord;
#define MAP_TABLES 2u
#define MAP_WHOLE 0u
#define MAP_COMPENSATED 1u

// The buffers of a scene beside its tree's, each once, as BVH_BUFFERS in shared/bvh.h.
// vertices: the first is for triangles that have none of their own. What follows them is there
// where the scene needs it, by the index of the vertex: uvs are the sets of texture coordinates
// after the first, two floats each, set by set; colors linear RGBA of 16 bits each; tangents
// octahedral, with the lowest bit replaced by the sign of the bitangent.
// bulges: by surface, of scenes with curved triangles; see src/upload/bulge.h.
// albedos: tables of shared/albedo.h; the first is that of reflection.
// media: of scenes that have some; the first is what is around everything.
// grids, voxels: of media that are not as dense everywhere; see GridRecord.
// spectrum: of scenes that disperse light; see shared/spectrum.h.
// srgb: 256 entries, from 8-bit sRGB to linear. environment: 3 floats per pixel.
// environment_alias: MAP_TABLES entries per pixel.
#define SCENE_BUFFERS(BUFFER)                                                                      \
    BUFFER(SurfaceRecord, surfaces, "surfaces")                                                    \
    BUFFER(uint, bulges, "bulges of curved triangles")                                             \
    BUFFER(VertexRecord, vertices, "vertices")                                                     \
    BUFFER(float, uvs, "further texture coordinates")                                              \
    BUFFER(uint, colors, "vertex colours")                                                         \
    BUFFER(uint, tangents, "tangents")                                                             \
    BUFFER(MaterialRecord, materials, "materials")                                                 \
    BUFFER(MediumRecord, media, "media")                                                           \
    BUFFER(GridRecord, grids, "grids of media")                                                    \
    BUFFER(uint, voxels, "densities of media")                                                     \
    BUFFER(uint, albedos, "directional albedos")                                                   \
    BUFFER(SpectrumKnot, spectrum, "spectrum of dispersed light")                                  \
    BUFFER(LightRecord, lights, "lights")                                                          \
    BUFFER(LightBranch, light_tree, "light tree")                                                  \
    BUFFER(TextureRecord, textures, "texture records")                                             \
    BUFFER(uint, texels, "texels")                                                                 \
    BUFFER(float, srgb, "sRGB table")                                                              \
    BUFFER(float, environment, "environment pixels")                                               \
    BUFFER(AliasRecord, environment_alias, "environment sampling")

#endif
