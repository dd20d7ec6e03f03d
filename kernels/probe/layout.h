// Every field of every shared struct, once, for both compilers: SIZE(Type) and OFFSET(Type, field)
// are the includer's. Written by tools/list_fields.py from shared/*.h.
#ifndef ONDE_PROBE_LAYOUT_H
#define ONDE_PROBE_LAYOUT_H

#include "shared/albedo.h"
#include "shared/aovs.h"
#include "shared/bvh.h"
#include "shared/columns.h"
#include "shared/denoise.h"
#include "shared/frame.h"
#include "shared/inspect.h"
#include "shared/items.h"
#include "shared/light_tracing.h"
#include "shared/motion.h"
#include "shared/profile.h"
#include "shared/raster.h"
#include "shared/scene.h"
#include "shared/spectrum.h"
#include "shared/types.h"
#include "shared/volumes.h"
#include "shared/whitted.h"

#define SHARED_LAYOUT(SIZE, OFFSET)                                                                \
    SIZE(BvhNode)                                                                                  \
    OFFSET(BvhNode, low_x)                                                                         \
    OFFSET(BvhNode, high_x)                                                                        \
    OFFSET(BvhNode, low_y)                                                                         \
    OFFSET(BvhNode, high_y)                                                                        \
    OFFSET(BvhNode, low_z)                                                                         \
    OFFSET(BvhNode, high_z)                                                                        \
    OFFSET(BvhNode, child)                                                                         \
    OFFSET(BvhNode, unused)                                                                        \
    SIZE(TriangleBlock)                                                                            \
    OFFSET(TriangleBlock, v0_x)                                                                    \
    OFFSET(TriangleBlock, v0_y)                                                                    \
    OFFSET(TriangleBlock, v0_z)                                                                    \
    OFFSET(TriangleBlock, e1_x)                                                                    \
    OFFSET(TriangleBlock, e1_y)                                                                    \
    OFFSET(TriangleBlock, e1_z)                                                                    \
    OFFSET(TriangleBlock, e2_x)                                                                    \
    OFFSET(TriangleBlock, e2_y)                                                                    \
    OFFSET(TriangleBlock, e2_z)                                                                    \
    OFFSET(TriangleBlock, primitive)                                                               \
    SIZE(BvhCompressed)                                                                            \
    OFFSET(BvhCompressed, origin)                                                                  \
    OFFSET(BvhCompressed, exponent)                                                                \
    OFFSET(BvhCompressed, inner)                                                                   \
    OFFSET(BvhCompressed, child)                                                                   \
    OFFSET(BvhCompressed, slot)                                                                    \
    OFFSET(BvhCompressed, leaf)                                                                    \
    OFFSET(BvhCompressed, low_x)                                                                   \
    OFFSET(BvhCompressed, high_x)                                                                  \
    OFFSET(BvhCompressed, low_y)                                                                   \
    OFFSET(BvhCompressed, high_y)                                                                  \
    OFFSET(BvhCompressed, low_z)                                                                   \
    OFFSET(BvhCompressed, high_z)                                                                  \
    SIZE(BvhPair)                                                                                  \
    OFFSET(BvhPair, low_x)                                                                         \
    OFFSET(BvhPair, high_x)                                                                        \
    OFFSET(BvhPair, low_y)                                                                         \
    OFFSET(BvhPair, high_y)                                                                        \
    OFFSET(BvhPair, low_z)                                                                         \
    OFFSET(BvhPair, high_z)                                                                        \
    OFFSET(BvhPair, child)                                                                         \
    OFFSET(BvhPair, unused)                                                                        \
    SIZE(BvhSlot)                                                                                  \
    OFFSET(BvhSlot, v0)                                                                            \
    OFFSET(BvhSlot, kind)                                                                          \
    OFFSET(BvhSlot, e1)                                                                            \
    OFFSET(BvhSlot, primitive)                                                                     \
    OFFSET(BvhSlot, e2)                                                                            \
    OFFSET(BvhSlot, unused)                                                                        \
    SIZE(BvhSphere)                                                                                \
    OFFSET(BvhSphere, center)                                                                      \
    OFFSET(BvhSphere, radius)                                                                      \
    OFFSET(BvhSphere, primitive)                                                                   \
    OFFSET(BvhSphere, kind)                                                                        \
    OFFSET(BvhSphere, unused)                                                                      \
    SIZE(BvhInstance)                                                                              \
    OFFSET(BvhInstance, world_to_object)                                                           \
    OFFSET(BvhInstance, object_to_world)                                                           \
    OFFSET(BvhInstance, root)                                                                      \
    OFFSET(BvhInstance, scale)                                                                     \
    OFFSET(BvhInstance, steps)                                                                     \
    OFFSET(BvhInstance, keys)                                                                      \
    OFFSET(BvhInstance, unused)                                                                    \
    SIZE(DenoiseBand)                                                                              \
    OFFSET(DenoiseBand, width)                                                                     \
    OFFSET(DenoiseBand, height)                                                                    \
    OFFSET(DenoiseBand, first_row)                                                                 \
    OFFSET(DenoiseBand, rows)                                                                      \
    OFFSET(DenoiseBand, stride)                                                                    \
    OFFSET(DenoiseBand, plane)                                                                     \
    SIZE(FrameRecord)                                                                              \
    OFFSET(FrameRecord, origin)                                                                    \
    OFFSET(FrameRecord, aperture_radius)                                                           \
    OFFSET(FrameRecord, corner)                                                                    \
    OFFSET(FrameRecord, focus_distance)                                                            \
    OFFSET(FrameRecord, step_x)                                                                    \
    OFFSET(FrameRecord, orthographic)                                                              \
    OFFSET(FrameRecord, step_y)                                                                    \
    OFFSET(FrameRecord, aperture_blades)                                                           \
    OFFSET(FrameRecord, lens_u)                                                                    \
    OFFSET(FrameRecord, aperture_turn)                                                             \
    OFFSET(FrameRecord, lens_v)                                                                    \
    OFFSET(FrameRecord, projection)                                                                \
    OFFSET(FrameRecord, forward)                                                                   \
    OFFSET(FrameRecord, setback)                                                                   \
    OFFSET(FrameRecord, width)                                                                     \
    OFFSET(FrameRecord, height)                                                                    \
    OFFSET(FrameRecord, seed)                                                                      \
    OFFSET(FrameRecord, max_depth)                                                                 \
    OFFSET(FrameRecord, roulette_start)                                                            \
    OFFSET(FrameRecord, light_count)                                                               \
    OFFSET(FrameRecord, environment_light)                                                         \
    OFFSET(FrameRecord, environment_width)                                                         \
    OFFSET(FrameRecord, environment_height)                                                        \
    OFFSET(FrameRecord, environment_radiance)                                                      \
    OFFSET(FrameRecord, environment_rotation)                                                      \
    OFFSET(FrameRecord, ground_share)                                                              \
    OFFSET(FrameRecord, ground_height)                                                             \
    OFFSET(FrameRecord, most_radiance)                                                             \
    OFFSET(FrameRecord, environment_group)                                                         \
    OFFSET(FrameRecord, environment_floor)                                                         \
    OFFSET(FrameRecord, environment_scale)                                                         \
    OFFSET(FrameRecord, fisheye_step)                                                              \
    OFFSET(FrameRecord, camera_mover)                                                              \
    OFFSET(FrameRecord, first_sun)                                                                 \
    OFFSET(FrameRecord, sun_count)                                                                 \
    OFFSET(FrameRecord, unused)                                                                    \
    OFFSET(FrameRecord, filter_table)                                                              \
    SIZE(SpectrumKnot)                                                                             \
    OFFSET(SpectrumKnot, bend)                                                                     \
    OFFSET(SpectrumKnot, color)                                                                    \
    SIZE(MaterialRecord)                                                                           \
    OFFSET(MaterialRecord, kind)                                                                   \
    OFFSET(MaterialRecord, lobes)                                                                  \
    OFFSET(MaterialRecord, two_sided)                                                              \
    OFFSET(MaterialRecord, alpha_mode)                                                             \
    OFFSET(MaterialRecord, double_sided)                                                           \
    OFFSET(MaterialRecord, group)                                                                  \
    OFFSET(MaterialRecord, albedos)                                                                \
    OFFSET(MaterialRecord, other)                                                                  \
    OFFSET(MaterialRecord, beckmann)                                                               \
    OFFSET(MaterialRecord, blocks)                                                                 \
    OFFSET(MaterialRecord, medium)                                                                 \
    OFFSET(MaterialRecord, absorption)                                                             \
    OFFSET(MaterialRecord, grain)                                                                  \
    OFFSET(MaterialRecord, base_color)                                                             \
    OFFSET(MaterialRecord, edge_tint)                                                              \
    OFFSET(MaterialRecord, emission)                                                               \
    OFFSET(MaterialRecord, specular_color)                                                         \
    OFFSET(MaterialRecord, diffuse_transmission_color)                                             \
    OFFSET(MaterialRecord, sheen_color)                                                            \
    OFFSET(MaterialRecord, roughness)                                                              \
    OFFSET(MaterialRecord, metallic)                                                               \
    OFFSET(MaterialRecord, ior)                                                                    \
    OFFSET(MaterialRecord, specular)                                                               \
    OFFSET(MaterialRecord, transmission)                                                           \
    OFFSET(MaterialRecord, diffuse_transmission)                                                   \
    OFFSET(MaterialRecord, clearcoat)                                                              \
    OFFSET(MaterialRecord, clearcoat_roughness)                                                    \
    OFFSET(MaterialRecord, clearcoat_normal_scale)                                                 \
    OFFSET(MaterialRecord, sheen_roughness)                                                        \
    OFFSET(MaterialRecord, iridescence)                                                            \
    OFFSET(MaterialRecord, iridescence_ior)                                                        \
    OFFSET(MaterialRecord, iridescence_thickness)                                                  \
    OFFSET(MaterialRecord, iridescence_thickness_minimum)                                          \
    OFFSET(MaterialRecord, anisotropy)                                                             \
    OFFSET(MaterialRecord, inner_reflection)                                                       \
    OFFSET(MaterialRecord, blend)                                                                  \
    OFFSET(MaterialRecord, dispersion)                                                             \
    OFFSET(MaterialRecord, normal_scale)                                                           \
    OFFSET(MaterialRecord, alpha)                                                                  \
    OFFSET(MaterialRecord, alpha_cutoff)                                                           \
    OFFSET(MaterialRecord, texture)                                                                \
    SIZE(MediumRecord)                                                                             \
    OFFSET(MediumRecord, extinction)                                                               \
    OFFSET(MediumRecord, scattering)                                                               \
    OFFSET(MediumRecord, emission)                                                                 \
    OFFSET(MediumRecord, anisotropy)                                                               \
    OFFSET(MediumRecord, grid)                                                                     \
    OFFSET(MediumRecord, unused)                                                                   \
    SIZE(GridRecord)                                                                               \
    OFFSET(GridRecord, to_samples)                                                                 \
    OFFSET(GridRecord, low)                                                                        \
    OFFSET(GridRecord, high)                                                                       \
    OFFSET(GridRecord, scale)                                                                      \
    OFFSET(GridRecord, bricks)                                                                     \
    OFFSET(GridRecord, table)                                                                      \
    OFFSET(GridRecord, unused)                                                                     \
    SIZE(VertexRecord)                                                                             \
    OFFSET(VertexRecord, normal)                                                                   \
    OFFSET(VertexRecord, uv)                                                                       \
    SIZE(AnySurface)                                                                               \
    OFFSET(AnySurface, tag)                                                                        \
    OFFSET(AnySurface, light)                                                                      \
    SIZE(TriangleSurface)                                                                          \
    OFFSET(TriangleSurface, tag)                                                                   \
    OFFSET(TriangleSurface, light)                                                                 \
    OFFSET(TriangleSurface, vertex)                                                                \
    OFFSET(TriangleSurface, geometric)                                                             \
    OFFSET(TriangleSurface, plane)                                                                 \
    SIZE(SphereSurface)                                                                            \
    OFFSET(SphereSurface, tag)                                                                     \
    OFFSET(SphereSurface, light)                                                                   \
    OFFSET(SphereSurface, center)                                                                  \
    OFFSET(SphereSurface, radius)                                                                  \
    OFFSET(SphereSurface, unused)                                                                  \
    SIZE(ShapeSurface)                                                                             \
    OFFSET(ShapeSurface, tag)                                                                      \
    OFFSET(ShapeSurface, light)                                                                    \
    OFFSET(ShapeSurface, shape)                                                                    \
    OFFSET(ShapeSurface, minor_radius)                                                             \
    OFFSET(ShapeSurface, unused)                                                                   \
    SIZE(SurfaceRecord)                                                                            \
    OFFSET(SurfaceRecord, any)                                                                     \
    OFFSET(SurfaceRecord, any.tag)                                                                 \
    OFFSET(SurfaceRecord, any.light)                                                               \
    OFFSET(SurfaceRecord, triangle)                                                                \
    OFFSET(SurfaceRecord, triangle.tag)                                                            \
    OFFSET(SurfaceRecord, triangle.light)                                                          \
    OFFSET(SurfaceRecord, triangle.vertex)                                                         \
    OFFSET(SurfaceRecord, triangle.geometric)                                                      \
    OFFSET(SurfaceRecord, triangle.plane)                                                          \
    OFFSET(SurfaceRecord, sphere)                                                                  \
    OFFSET(SurfaceRecord, sphere.tag)                                                              \
    OFFSET(SurfaceRecord, sphere.light)                                                            \
    OFFSET(SurfaceRecord, sphere.center)                                                           \
    OFFSET(SurfaceRecord, sphere.radius)                                                           \
    OFFSET(SurfaceRecord, sphere.unused)                                                           \
    OFFSET(SurfaceRecord, shape)                                                                   \
    OFFSET(SurfaceRecord, shape.tag)                                                               \
    OFFSET(SurfaceRecord, shape.light)                                                             \
    OFFSET(SurfaceRecord, shape.shape)                                                             \
    OFFSET(SurfaceRecord, shape.minor_radius)                                                      \
    OFFSET(SurfaceRecord, shape.unused)                                                            \
    SIZE(TriangleLightRecord)                                                                      \
    OFFSET(TriangleLightRecord, corner)                                                            \
    OFFSET(TriangleLightRecord, area)                                                              \
    OFFSET(TriangleLightRecord, edge1)                                                             \
    OFFSET(TriangleLightRecord, edge2)                                                             \
    OFFSET(TriangleLightRecord, orientation)                                                       \
    SIZE(DiskLightRecord)                                                                          \
    OFFSET(DiskLightRecord, center)                                                                \
    OFFSET(DiskLightRecord, area)                                                                  \
    OFFSET(DiskLightRecord, radius1)                                                               \
    OFFSET(DiskLightRecord, radius2)                                                               \
    OFFSET(DiskLightRecord, orientation)                                                           \
    SIZE(SphereLightRecord)                                                                        \
    OFFSET(SphereLightRecord, center)                                                              \
    OFFSET(SphereLightRecord, radius)                                                              \
    SIZE(PointLightRecord)                                                                         \
    OFFSET(PointLightRecord, position)                                                             \
    OFFSET(PointLightRecord, intensity)                                                            \
    SIZE(SpotLightRecord)                                                                          \
    OFFSET(SpotLightRecord, position)                                                              \
    OFFSET(SpotLightRecord, back)                                                                  \
    OFFSET(SpotLightRecord, intensity)                                                             \
    OFFSET(SpotLightRecord, opening)                                                               \
    OFFSET(SpotLightRecord, steepness)                                                             \
    SIZE(PhotometricLightRecord)                                                                   \
    OFFSET(PhotometricLightRecord, position)                                                       \
    OFFSET(PhotometricLightRecord, intensity)                                                      \
    OFFSET(PhotometricLightRecord, turn)                                                           \
    OFFSET(PhotometricLightRecord, opening)                                                        \
    SIZE(DirectionalLightRecord)                                                                   \
    OFFSET(DirectionalLightRecord, to_light)                                                       \
    OFFSET(DirectionalLightRecord, irradiance)                                                     \
    SIZE(SunLightRecord)                                                                           \
    OFFSET(SunLightRecord, to_light)                                                               \
    OFFSET(SunLightRecord, radiance)                                                               \
    OFFSET(SunLightRecord, opening)                                                                \
    SIZE(EnvironmentLightRecord)                                                                   \
    OFFSET(EnvironmentLightRecord, unused)                                                         \
    SIZE(LightRecord)                                                                              \
    OFFSET(LightRecord, kind)                                                                      \
    OFFSET(LightRecord, pmf)                                                                       \
    OFFSET(LightRecord, alias_below)                                                               \
    OFFSET(LightRecord, alias)                                                                     \
    OFFSET(LightRecord, material)                                                                  \
    OFFSET(LightRecord, surface)                                                                   \
    OFFSET(LightRecord, group)                                                                     \
    OFFSET(LightRecord, trail)                                                                     \
    OFFSET(LightRecord, as.triangle)                                                               \
    OFFSET(LightRecord, as.triangle.corner)                                                        \
    OFFSET(LightRecord, as.triangle.area)                                                          \
    OFFSET(LightRecord, as.triangle.edge1)                                                         \
    OFFSET(LightRecord, as.triangle.edge2)                                                         \
    OFFSET(LightRecord, as.triangle.orientation)                                                   \
    OFFSET(LightRecord, as.sphere)                                                                 \
    OFFSET(LightRecord, as.sphere.center)                                                          \
    OFFSET(LightRecord, as.sphere.radius)                                                          \
    OFFSET(LightRecord, as.disk)                                                                   \
    OFFSET(LightRecord, as.disk.center)                                                            \
    OFFSET(LightRecord, as.disk.area)                                                              \
    OFFSET(LightRecord, as.disk.radius1)                                                           \
    OFFSET(LightRecord, as.disk.radius2)                                                           \
    OFFSET(LightRecord, as.disk.orientation)                                                       \
    OFFSET(LightRecord, as.point)                                                                  \
    OFFSET(LightRecord, as.point.position)                                                         \
    OFFSET(LightRecord, as.point.intensity)                                                        \
    OFFSET(LightRecord, as.spot)                                                                   \
    OFFSET(LightRecord, as.spot.position)                                                          \
    OFFSET(LightRecord, as.spot.back)                                                              \
    OFFSET(LightRecord, as.spot.intensity)                                                         \
    OFFSET(LightRecord, as.spot.opening)                                                           \
    OFFSET(LightRecord, as.spot.steepness)                                                         \
    OFFSET(LightRecord, as.photometric)                                                            \
    OFFSET(LightRecord, as.photometric.position)                                                   \
    OFFSET(LightRecord, as.photometric.intensity)                                                  \
    OFFSET(LightRecord, as.photometric.turn)                                                       \
    OFFSET(LightRecord, as.photometric.opening)                                                    \
    OFFSET(LightRecord, as.directional)                                                            \
    OFFSET(LightRecord, as.directional.to_light)                                                   \
    OFFSET(LightRecord, as.directional.irradiance)                                                 \
    OFFSET(LightRecord, as.sun)                                                                    \
    OFFSET(LightRecord, as.sun.to_light)                                                           \
    OFFSET(LightRecord, as.sun.radiance)                                                           \
    OFFSET(LightRecord, as.sun.opening)                                                            \
    OFFSET(LightRecord, as.environment)                                                            \
    OFFSET(LightRecord, as.environment.unused)                                                     \
    SIZE(LightBranch)                                                                              \
    OFFSET(LightBranch, center)                                                                    \
    OFFSET(LightBranch, power)                                                                     \
    OFFSET(LightBranch, radius_reach)                                                              \
    OFFSET(LightBranch, axis_xy)                                                                   \
    OFFSET(LightBranch, axis_z_spread)                                                             \
    OFFSET(LightBranch, next)                                                                      \
    SIZE(TextureRecord)                                                                            \
    OFFSET(TextureRecord, offset)                                                                  \
    OFFSET(TextureRecord, coarser)                                                                 \
    OFFSET(TextureRecord, width)                                                                   \
    OFFSET(TextureRecord, height)                                                                  \
    OFFSET(TextureRecord, wrap_u)                                                                  \
    OFFSET(TextureRecord, wrap_v)                                                                  \
    OFFSET(TextureRecord, filter)                                                                  \
    OFFSET(TextureRecord, uv_set)                                                                  \
    OFFSET(TextureRecord, u)                                                                       \
    OFFSET(TextureRecord, v)                                                                       \
    OFFSET(TextureRecord, format)                                                                  \
    OFFSET(TextureRecord, buffer)                                                                  \
    SIZE(AliasRecord)                                                                              \
    OFFSET(AliasRecord, below)                                                                     \
    OFFSET(AliasRecord, alias)                                                                     \
    SIZE(HitReport)                                                                                \
    OFFSET(HitReport, origin)                                                                      \
    OFFSET(HitReport, direction)                                                                   \
    OFFSET(HitReport, t)                                                                           \
    OFFSET(HitReport, primitive)                                                                   \
    OFFSET(HitReport, instance)                                                                    \
    OFFSET(HitReport, material)                                                                    \
    OFFSET(HitReport, front)                                                                       \
    OFFSET(HitReport, position)                                                                    \
    OFFSET(HitReport, normal)                                                                      \
    SIZE(NodeReport)                                                                               \
    OFFSET(NodeReport, hit)                                                                        \
    OFFSET(NodeReport, hit.origin)                                                                 \
    OFFSET(NodeReport, hit.direction)                                                              \
    OFFSET(NodeReport, hit.t)                                                                      \
    OFFSET(NodeReport, hit.primitive)                                                              \
    OFFSET(NodeReport, hit.instance)                                                               \
    OFFSET(NodeReport, hit.material)                                                               \
    OFFSET(NodeReport, hit.front)                                                                  \
    OFFSET(NodeReport, hit.position)                                                               \
    OFFSET(NodeReport, hit.normal)                                                                 \
    OFFSET(NodeReport, parent)                                                                     \
    OFFSET(NodeReport, level)                                                                      \
    OFFSET(NodeReport, kind)                                                                       \
    OFFSET(NodeReport, alive)                                                                      \
    OFFSET(NodeReport, factor)                                                                     \
    OFFSET(NodeReport, product)                                                                    \
    OFFSET(NodeReport, emission)                                                                   \
    OFFSET(NodeReport, ambient)                                                                    \
    OFFSET(NodeReport, own)                                                                        \
    OFFSET(NodeReport, returned)                                                                   \
    SIZE(SourceReport)                                                                             \
    OFFSET(SourceReport, visible)                                                                  \
    OFFSET(SourceReport, diffuse)                                                                  \
    OFFSET(SourceReport, specular)                                                                 \
    SIZE(BounceReport)                                                                             \
    OFFSET(BounceReport, hit)                                                                      \
    OFFSET(BounceReport, hit.origin)                                                               \
    OFFSET(BounceReport, hit.direction)                                                            \
    OFFSET(BounceReport, hit.t)                                                                    \
    OFFSET(BounceReport, hit.primitive)                                                            \
    OFFSET(BounceReport, hit.instance)                                                             \
    OFFSET(BounceReport, hit.material)                                                             \
    OFFSET(BounceReport, hit.front)                                                                \
    OFFSET(BounceReport, hit.position)                                                             \
    OFFSET(BounceReport, hit.normal)                                                               \
    OFFSET(BounceReport, throughput)                                                               \
    OFFSET(BounceReport, emitted)                                                                  \
    OFFSET(BounceReport, light)                                                                    \
    OFFSET(BounceReport, light_pdf)                                                                \
    OFFSET(BounceReport, light_direction)                                                          \
    OFFSET(BounceReport, light_distance)                                                           \
    OFFSET(BounceReport, light_radiance)                                                           \
    OFFSET(BounceReport, blocked)                                                                  \
    OFFSET(BounceReport, lobes)                                                                    \
    OFFSET(BounceReport, probability)                                                              \
    OFFSET(BounceReport, diffuse)                                                                  \
    OFFSET(BounceReport, f0)                                                                       \
    OFFSET(BounceReport, alpha)                                                                    \
    OFFSET(BounceReport, eta)                                                                      \
    OFFSET(BounceReport, next_direction)                                                           \
    OFFSET(BounceReport, next_pdf)                                                                 \
    OFFSET(BounceReport, next_throughput)                                                          \
    OFFSET(BounceReport, alive)                                                                    \
    SIZE(LightTracingRecord)                                                                       \
    OFFSET(LightTracingRecord, center)                                                             \
    OFFSET(LightTracingRecord, radius)                                                             \
    OFFSET(LightTracingRecord, splat_scale)                                                        \
    OFFSET(LightTracingRecord, unused)                                                             \
    SIZE(MoverRecord)                                                                              \
    OFFSET(MoverRecord, step)                                                                      \
    OFFSET(MoverRecord, to_world)                                                                  \
    OFFSET(MoverRecord, deforms)                                                                   \
    OFFSET(MoverRecord, first_triangle)                                                            \
    OFFSET(MoverRecord, unused)                                                                    \
    SIZE(RasterRecord)                                                                             \
    OFFSET(RasterRecord, background)                                                               \
    OFFSET(RasterRecord, width)                                                                    \
    OFFSET(RasterRecord, height)                                                                   \
    OFFSET(RasterRecord, instance_count)                                                           \
    OFFSET(RasterRecord, triangle_count)                                                           \
    OFFSET(RasterRecord, primitive_count)                                                          \
    OFFSET(RasterRecord, subpixels)                                                                \
    OFFSET(RasterRecord, unused)                                                                   \
    SIZE(RasterInstance)                                                                           \
    OFFSET(RasterInstance, to_screen)                                                              \
    OFFSET(RasterInstance, first_primitive)                                                        \
    OFFSET(RasterInstance, first_triangle)                                                         \
    OFFSET(RasterInstance, unused)                                                                 \
    SIZE(RasterSphere)                                                                             \
    OFFSET(RasterSphere, center)                                                                   \
    OFFSET(RasterSphere, radius_pixels)                                                            \
    OFFSET(RasterSphere, radius)                                                                   \
    OFFSET(RasterSphere, material)                                                                 \
    OFFSET(RasterSphere, unused)                                                                   \
    SIZE(RasterMaterial)                                                                           \
    OFFSET(RasterMaterial, color)                                                                  \
    OFFSET(RasterMaterial, texture)                                                                \
    OFFSET(RasterMaterial, alpha)                                                                  \
    OFFSET(RasterMaterial, unused)                                                                 \
    SIZE(BoxVolume)                                                                                \
    OFFSET(BoxVolume, low)                                                                         \
    OFFSET(BoxVolume, high)                                                                        \
    OFFSET(BoxVolume, reach)                                                                       \
    OFFSET(BoxVolume, unused)                                                                      \
    SIZE(OrientedBoxVolume)                                                                        \
    OFFSET(OrientedBoxVolume, axes)                                                                \
    OFFSET(OrientedBoxVolume, low)                                                                 \
    OFFSET(OrientedBoxVolume, high)                                                                \
    OFFSET(OrientedBoxVolume, reach)                                                               \
    SIZE(SlabsVolume)                                                                              \
    OFFSET(SlabsVolume, low)                                                                       \
    OFFSET(SlabsVolume, high)                                                                      \
    OFFSET(SlabsVolume, reach)                                                                     \
    OFFSET(SlabsVolume, unused)                                                                    \
    SIZE(SphereVolume)                                                                             \
    OFFSET(SphereVolume, center)                                                                   \
    OFFSET(SphereVolume, radius)                                                                   \
    SIZE(WhittedRecord)                                                                            \
    OFFSET(WhittedRecord, ambient)                                                                 \
    OFFSET(WhittedRecord, has_background)                                                          \
    OFFSET(WhittedRecord, background)                                                              \
    OFFSET(WhittedRecord, epsilon)                                                                 \
    OFFSET(WhittedRecord, saturate)                                                                \
    OFFSET(WhittedRecord, source_reflectivity)                                                     \
    OFFSET(WhittedRecord, distance_falloff)                                                        \
    OFFSET(WhittedRecord, fresnel)                                                                 \
    OFFSET(WhittedRecord, max_depth)                                                               \
    OFFSET(WhittedRecord, source_count)                                                            \
    OFFSET(WhittedRecord, wavelengths)                                                             \
    OFFSET(WhittedRecord, pad)                                                                     \
    OFFSET(WhittedRecord, bend)                                                                    \
    OFFSET(WhittedRecord, filter)                                                                  \
    SIZE(PhongRecord)                                                                              \
    OFFSET(PhongRecord, color)                                                                     \
    OFFSET(PhongRecord, texture)                                                                   \
    OFFSET(PhongRecord, ambient)                                                                   \
    OFFSET(PhongRecord, diffuse)                                                                   \
    OFFSET(PhongRecord, specular)                                                                  \
    OFFSET(PhongRecord, exponent)                                                                  \
    OFFSET(PhongRecord, reflection)                                                                \
    OFFSET(PhongRecord, transmission)                                                              \
    OFFSET(PhongRecord, ior)                                                                       \
    OFFSET(PhongRecord, dispersion)                                                                \
    SIZE(SourceRecord)                                                                             \
    OFFSET(SourceRecord, position)                                                                 \
    OFFSET(SourceRecord, kind)                                                                     \
    OFFSET(SourceRecord, edge1)                                                                    \
    OFFSET(SourceRecord, radius)                                                                   \
    OFFSET(SourceRecord, edge2)                                                                    \
    OFFSET(SourceRecord, two_sided)                                                                \
    OFFSET(SourceRecord, intensity)                                                                \
    OFFSET(SourceRecord, samples)

#endif
