// Rays against bounding volumes and nothing else: what the laboratory counts and times. Rays are
// six columns: origin, direction; a work item takes VOLUME_ITEMS of them, and `count` is a multiple
// of that. For each ray, how many of the volumes it meets.
#include "chapter/volumes.h"
#include "shared/items.h"

#define VOLUME_KERNEL(name, Type, is_met)                                                          \
    __kernel void name(uint count, __global const float* rays, __global const Type* volumes,       \
                       uint volume_count, __global uint* met) {                                    \
        const uint first = get_global_id(0) * VOLUME_ITEMS;                                        \
        if (first >= count) return;                                                                \
        for (uint i = first; i < first + VOLUME_ITEMS; i += ONDE_WIDTH) {                          \
            const size_t column = count;                                                           \
            const real3 origin = make3(load_real(rays + i), load_real(rays + column + i),          \
                                       load_real(rays + 2 * column + i));                          \
            const real3 direction =                                                                \
                make3(load_real(rays + 3 * column + i), load_real(rays + 4 * column + i),          \
                      load_real(rays + 5 * column + i));                                           \
            natural sum = 0;                                                                       \
            for (uint k = 0; k < volume_count; k++)                                                \
                sum += choose(is_met, (natural)(1u), (natural)(0u));                               \
            store_natural((__global float*)met + i, sum);                                          \
        }                                                                                          \
    }

VOLUME_KERNEL(test_box, BoxVolume, box_met(volumes[k], origin, direction))
VOLUME_KERNEL(test_oriented_box, OrientedBoxVolume, oriented_box_met(volumes[k], origin, direction))
VOLUME_KERNEL(test_few_slabs, SlabsVolume, slabs_met(volumes[k], FEW_SLABS, origin, direction))
VOLUME_KERNEL(test_many_slabs, SlabsVolume, slabs_met(volumes[k], MANY_SLABS, origin, direction))
VOLUME_KERNEL(test_sphere, SphereVolume, sphere_met(volumes[k], origin, direction))
