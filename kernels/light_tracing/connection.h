// What a vertex of a light path gives to the camera.
#ifndef ONDE_LIGHT_TRACING_CONNECTION_H
#define ONDE_LIGHT_TRACING_CONNECTION_H

#include "shade/camera_motion.h"
#include "shade/connection.h"
#include "shade/vertex.h"

#if ONDE_PROJECTIONS
// A row beyond a pole is one on the other side of it: where x is there, of a panorama.
INLINE real beyond_pole(__global const FrameRecord* frame, real x, FilterChoice* y) {
    const float last = (float)(frame->height) - 1.0f;
    const mask above = y->pixel<0.0f, below = y->pixel> last;
    y->pixel = choose(above, -1.0f - y->pixel, y->pixel);
    y->pixel = choose(below, 2.0f * last + 1.0f - y->pixel, y->pixel);
    return choose(above | below, x + 0.5f * (float)(frame->width), x);
}
#endif

// The link's light, `value` before the filter, to one pixel; u chooses it. `origin` is where the
// ray toward the camera starts.
INLINE Connection connect_film(__global const FrameRecord* frame, CameraLink link, real3 origin,
                               real3 value, real2 u, mask lanes) {
    Connection c = no_connection();
    if (!mask_bits(lanes)) return c;
    FilterChoice y = choose_pixel(frame, choose(lanes, link.y, (real)(0.0f)), u.y);
#if ONDE_PROJECTIONS
    if (is_panorama(frame)) link.x = beyond_pole(frame, link.x, &y);
#endif
    FilterChoice x = choose_pixel(frame, choose(lanes, link.x, (real)(0.0f)), u.x);
#if ONDE_PROJECTIONS
    if (is_panorama(frame)) x.pixel -= frame->width * floor(x.pixel / (float)(frame->width));
#endif
    c.value = scale3(value, x.weight * y.weight);
    const mask on_film = (x.pixel >= 0.0f) & (y.pixel >= 0.0f) & (x.pixel < (float)frame->width) &
                         (y.pixel < (float)frame->height);
    const mask useful = lanes & on_film & nonzero3(c.value);
    const natural column = as_natural(to_integer(x.pixel)), row = as_natural(to_integer(y.pixel));
    c.target = choose(useful, row * frame->width + column, (natural)(0u));
    const real3 to = sub3(link.camera, origin); // the origin's offset must not move the camera
    const real length = length3(to);
    c.origin = origin;
    c.direction = scale3(to, 1.0f / length);
    c.distance = choose(useful, length, (real)(0.0f));
    return c;
}

#endif
