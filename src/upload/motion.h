// Where things are at the next frame, as device records.
#pragma once

#include "shared/motion.h"
#include "upload/geometry.h"

namespace onde {

/// The arrays of MOTION_BUFFERS in shared/motion.h; empty where the scene has no next frame.
struct MotionArrays {
#define ONDE_ARRAY(Type, name, words) std::vector<Type> name;
    MOTION_BUFFERS(ONDE_ARRAY)
#undef ONDE_ARRAY
};

/// `flat` is the scene's own.
MotionArrays pack_motion(const Scene& scene, const FlatGeometry& flat);

} // namespace onde
