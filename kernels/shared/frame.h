// What is the same for every path of a frame, and the table of counters.
#ifndef ONDE_SHARED_FRAME_H
#define ONDE_SHARED_FRAME_H

#include "shared/types.h"

#define FILTER_TABLE_SIZE 64

// How directions become places of the film.
#define PROJECTION_RECTILINEAR 0u // on a plane, or rays are parallel
#define PROJECTION_PANORAMA 1u    // equirectangular, the whole sphere
#define PROJECTION_FISHEYE 2u     // equidistant, a circle

typedef struct {
    // Camera. A ray through pixel coordinates (x, y), y downward, leaves
    // origin + lens toward corner + x * step_x + y * step_y on the focus plane.
    float origin[3];
    float aperture_radius;
    float corner[3];
    float focus_distance;
    float step_x[3];
    uint orthographic; // 1: rays leave the screen itself, along `forward`
    float step_y[3];
    uint aperture_blades; // 0: the lens is round
    float lens_u[3];      // unit right
    float aperture_turn;  // of its first corner, in turns
    float lens_v[3];      // unit up
    uint projection;      // PROJECTION_...
    float forward[3];     // unit
    float setback;        // of the camera behind the screen that parallel rays leave

    uint width, height; // of the film
    uint seed;
    uint max_depth;      // the most surfaces a path may visit
    uint roulette_start; // first bounce at which Russian roulette may end a path
    uint light_count;
    uint environment_light; // index of the environment among the lights, or NO_INDEX
    uint environment_width, environment_height; // of the map; 0 when it is constant
    float environment_radiance[3];
    float environment_rotation; // in turns
    float ground_share[3];   // of a sample of light, in all the light that the ground receives: 1 /
                             // that
    float ground_height;     // y of the plane
    float most_radiance;     // of a sample, of films that have what is cut off beyond it
    uint environment_group;  // of lights
    float environment_floor; // the brightness up to which paths draw nothing of the map's pixels
    float environment_scale[2]; // of densities, over brightness, by MAP_...
    float fisheye_step;         // turns a pixel
    uint camera_mover; // the instance whose motion the camera has; NO_INDEX: it stands still
    uint first_sun, sun_count; // directional lights that have a size, among the lights
    uint unused[2];
    // Inverse cumulative distribution of the pixel filter, offsets in pixels.
    float filter_table[FILTER_TABLE_SIZE];
} FrameRecord;

// The counter table of a wave, [row][bounce]: queue lengths, and the ray statistics.
#define COUNTER_BOUNCES 1024
#define COUNTER_EXTENSION 0 // rays intersected for their closest hit
#define COUNTER_SHADOW 1    // rays tested for any hit
#define COUNTER_ROWS 2
#define COUNTER_SIZE (COUNTER_ROWS * COUNTER_BOUNCES)

// Samples whose radiance was not finite: how many, and the first of them.
#define INVALID_COUNT 0
#define INVALID_PIXEL 1 // x | y << 16
#define INVALID_SAMPLE 2
#define INVALID_SIZE 4

// What a path has met first, for the host: these words a path, where films count ids.
#define SEEN_PRIMITIVE 0
#define SEEN_INSTANCE 1
#define SEEN_WORDS 2
#define SEEN_REJECTED 0xfffffffeu // for a primitive: the sample was thrown away

#endif
