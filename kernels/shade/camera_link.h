// From a point to the camera: the inverse of camera_ray. Where the point lands on the film, how
// much of the film it stands for, and the pixel that its light is added to.
#ifndef ONDE_SHADE_CAMERA_LINK_H
#define ONDE_SHADE_CAMERA_LINK_H

#include "shade/camera.h"

// Pixels around the film from which a filter can still reach it.
#define FILM_MARGIN 2.0f

typedef struct {
    real3 camera;    // the point of the lens, or of the orthographic screen
    real3 direction; // unit, to it
    real x, y;       // film coordinates in pixels, y downward
    real importance; // film area in pixels over the point's area, facing the camera
    mask valid;      // before the camera, and on the film or near it
} CameraLink;

INLINE real3 lens_point(__global const FrameRecord* frame, real2 u) {
    const real2 lens = lens_place(frame, u);
    const real radius = (real)(frame->aperture_radius);
    return madd3(uniform3(frame->lens_v), lens.y * radius,
                 madd3(uniform3(frame->lens_u), lens.x * radius, uniform3(frame->origin)));
}

// One over the area of a pixel on the focus plane.
INLINE real pixels_per_area(__global const FrameRecord* frame) {
    const real3 step = uniform3(frame->step_x);
    return 1.0f / dot3(step, step);
}

// Sets the film coordinates of a point of the focus plane (of the screen when orthographic).
INLINE CameraLink place_on_film(__global const FrameRecord* frame, CameraLink link, real3 target) {
    const real3 from_corner = sub3(target, uniform3(frame->corner));
    const real scale = pixels_per_area(frame);
    link.x = dot3(from_corner, uniform3(frame->step_x)) * scale;
    link.y = dot3(from_corner, uniform3(frame->step_y)) * scale;
    link.valid = link.valid & (link.x > -FILM_MARGIN) & (link.y > -FILM_MARGIN) &
                 (link.x < (float)frame->width + FILM_MARGIN) &
                 (link.y < (float)frame->height + FILM_MARGIN);
    return link;
}

#if ONDE_PROJECTIONS
// The link of what lies in unit direction `d`, of a camera that sees more than a plane.
INLINE CameraLink wide_link(__global const FrameRecord* frame, real3 d) {
    const WidePlace place = wide_place(frame, d);
    CameraLink link;
    link.camera = uniform3(frame->origin);
    link.direction = negate3(d);
    link.x = place.x;
    link.y = place.y;
    link.importance = place.density;
    link.valid = wide_shows(frame, place.x, place.y);
    return link;
}
#endif

// The link of what lies in unit direction `d` from a point of the lens; its importance is film area
// over solid angle: f^2 / cos^3 of the focus plane at distance f, in pixels.
INLINE CameraLink camera_link_along(__global const FrameRecord* frame, real3 lens, real3 d) {
#if ONDE_PROJECTIONS
    if (is_wide(frame)) return wide_link(frame, d);
#endif
    const real cosine = dot3(d, uniform3(frame->forward));
    const real ahead = max_real(cosine, (real)(1e-6f));
    const real reach = frame->focus_distance / ahead;
    CameraLink link;
    link.camera = lens;
    link.direction = negate3(d);
    link.importance = pixels_per_area(frame) * reach * reach / ahead;
    link.valid = cosine > 1e-6f;
    return place_on_film(frame, link, madd3(d, reach, lens));
}

INLINE CameraLink screen_link(__global const FrameRecord* frame, real3 position) {
    const real3 forward = uniform3(frame->forward);
    const real distance = dot3(sub3(position, uniform3(frame->corner)), forward);
    CameraLink link;
    link.camera = madd3(forward, -distance, position);
    link.direction = negate3(forward);
    link.importance = pixels_per_area(frame);
    link.valid = distance > 0.0f;
    return place_on_film(frame, link, link.camera);
}

// The screen point of an orthographic camera that two uniform numbers name; its importance is one
// over their density.
INLINE CameraLink screen_point(__global const FrameRecord* frame, real2 u) {
    const float width = (float)frame->width + 2.0f * FILM_MARGIN;
    const float height = (float)frame->height + 2.0f * FILM_MARGIN;
    CameraLink link;
    link.x = fma(u.x, (real)(width), (real)(-FILM_MARGIN));
    link.y = fma(u.y, (real)(height), (real)(-FILM_MARGIN));
    link.camera = madd3(uniform3(frame->step_y), link.y,
                        madd3(uniform3(frame->step_x), link.x, uniform3(frame->corner)));
    link.direction = negate3(uniform3(frame->forward));
    link.importance = (real)(width * height);
    link.valid = link.x < width;
    return link;
}

// The link of a point, by two uniform numbers for the lens.
INLINE CameraLink camera_link(__global const FrameRecord* frame, real3 position, real2 u) {
    if (frame->orthographic) return screen_link(frame, position);
    const real3 lens = lens_point(frame, u);
    const real3 to = sub3(position, lens);
    const real distance = max_real(length3(to), (real)(1e-18f));
    CameraLink link = camera_link_along(frame, lens, scale3(to, 1.0f / distance));
    link.importance /= distance * distance;
    return link;
}

// The density of filter_offset: constant between the knots of its table.
INLINE real filter_density(__global const FrameRecord* frame, real offset) {
    natural i = (natural)(0u);
    for (uint step = FILTER_TABLE_SIZE / 2; step > 0; step /= 2) {
        const natural above = min(i + step, (natural)(FILTER_TABLE_SIZE - 1u));
        i = choose(gather_real(frame->filter_table, above) <= offset, above, i);
    }
    const natural next = min(i + 1u, (natural)(FILTER_TABLE_SIZE - 1u));
    const real low = gather_real(frame->filter_table, i);
    const real high = gather_real(frame->filter_table, next);
    const mask inside = (low <= offset) & (offset < high);
    const real width = choose(inside, high - low, (real)(1.0f));
    return choose(inside, 1.0f / (width * (FILTER_TABLE_SIZE - 1.0f)), (real)(0.0f));
}

typedef struct {
    real pixel;  // along one axis; may lie off the film
    real weight; // of the light that goes there
} FilterChoice;

// One of the up to three pixels whose filters reach x, in proportion to their values there, which
// add up to the weight: each pixel expects the integral that camera_ray samples.
INLINE FilterChoice choose_pixel(__global const FrameRecord* frame, real x, real u) {
    const real middle = floor(x);
    const real offset = x - middle - 0.5f;
    const real before = filter_density(frame, offset + 1.0f);
    const real at = filter_density(frame, offset);
    FilterChoice c;
    c.weight = before + at + filter_density(frame, offset - 1.0f);
    const real place = u * c.weight;
    const real shift = choose(place < before + at, (real)(0.0f), (real)(1.0f));
    c.pixel = middle + choose(place < before, (real)(-1.0f), shift);
    return c;
}

#endif
