// A camera that moves while the shutter is open: what it sees and is seen by is that of the camera
// at the opening, carried on.
#ifndef ONDE_SHADE_CAMERA_MOTION_H
#define ONDE_SHADE_CAMERA_MOTION_H

#include "shade/camera_link.h"
#include "shade/moved.h"

#if ONDE_SHUTTER

INLINE bool camera_moves(SceneView view) {
    return view.frame->camera_mover != NO_INDEX;
}

// From where things are as the shutter opens to where the camera has carried them since.
INLINE MovedRows camera_motion(SceneView view) {
    return moved_rows(view, (natural)(view.frame->camera_mover), view.bvh.time == view.bvh.time);
}

#endif

// The way that the camera looks.
INLINE real3 view_axis(SceneView view) {
    const real3 forward = uniform3(view.frame->forward);
#if ONDE_SHUTTER
    if (camera_moves(view)) {
        const MovedRows motion = camera_motion(view);
        return normalize3(rows_times(motion.to_world, forward));
    }
#endif
    return forward;
}

// A ray of the camera at the opening, later.
INLINE CameraRay carried_ray(SceneView view, CameraRay ray) {
#if ONDE_SHUTTER
    if (!camera_moves(view)) return ray;
    const MovedRows motion = camera_motion(view);
    ray.origin = add3(rows_times(motion.to_world, ray.origin), motion.world_offset);
    ray.direction = normalize3(rows_times(motion.to_world, ray.direction));
#endif
    return ray;
}

#if ONDE_SHUTTER
INLINE CameraLink carried_link(MovedRows motion, CameraLink link) {
    link.camera = add3(rows_times(motion.to_world, link.camera), motion.world_offset);
    link.direction = normalize3(rows_times(motion.to_world, link.direction));
    return link;
}
#endif

// camera_link, and camera_link_along from a point of the lens that two numbers name, at the moment
// of the view.
INLINE CameraLink link_of_point(SceneView view, real3 position, real2 u) {
#if ONDE_SHUTTER
    if (camera_moves(view)) {
        const MovedRows motion = camera_motion(view);
        const real3 before = add3(rows_times(motion.to_object, position), motion.object_offset);
        return carried_link(motion, camera_link(view.frame, before, u));
    }
#endif
    return camera_link(view.frame, position, u);
}
INLINE CameraLink link_along(SceneView view, real3 d, real2 u) {
    const real3 lens = lens_point(view.frame, u);
#if ONDE_SHUTTER
    if (camera_moves(view)) {
        const MovedRows motion = camera_motion(view);
        const real3 before = normalize3(rows_times(motion.to_object, d));
        return carried_link(motion, camera_link_along(view.frame, lens, before));
    }
#endif
    return camera_link_along(view.frame, lens, d);
}
// screen_point at that moment.
INLINE CameraLink link_of_screen(SceneView view, real2 u) {
    const CameraLink link = screen_point(view.frame, u);
#if ONDE_SHUTTER
    if (camera_moves(view)) return carried_link(camera_motion(view), link);
#endif
    return link;
}

#endif
