// Axis-aligned boxes in four lanes (the fourth is idle), so that a union is two instructions.
#pragma once

#include <glm/glm.hpp>

#include <limits>

namespace onde::accel {

using Lanes = float __attribute__((vector_size(16)));
using IntLanes = int __attribute__((vector_size(16)));

// Written so that no compiler has to prove the absence of NaN before it may use minps.
inline Lanes lower(Lanes a, Lanes b) {
#ifdef __SSE__
    return __builtin_ia32_minps(a, b);
#else
    return a < b ? a : b;
#endif
}
inline Lanes upper(Lanes a, Lanes b) {
#ifdef __SSE__
    return __builtin_ia32_maxps(a, b);
#else
    return a > b ? a : b;
#endif
}
inline Lanes lanes(glm::vec3 v) {
    return Lanes{v.x, v.y, v.z, 0.0f};
}
inline Lanes splat(float v) {
    return Lanes{v, v, v, v};
}

/// A box; empty when made, and then the neutral element of extend().
struct Box {
    Lanes low = splat(std::numeric_limits<float>::infinity());
    Lanes high = splat(-std::numeric_limits<float>::infinity());

    void extend(const Box& other) {
        low = lower(low, other.low);
        high = upper(high, other.high);
    }
    void extend(Lanes point) {
        low = lower(low, point);
        high = upper(high, point);
    }
    bool contains(const Box& other) const {
        for (int axis = 0; axis < 3; ++axis)
            if (!(low[axis] <= other.low[axis] && high[axis] >= other.high[axis])) return false;
        return true;
    }
    bool is_empty() const { return !(low[0] <= high[0]); }
    /// Of what two boxes share, which may be empty along any axis.
    bool has_points() const { return low[0] <= high[0] && low[1] <= high[1] && low[2] <= high[2]; }
    Box common(const Box& other) const { return {upper(low, other.low), lower(high, other.high)}; }
    Box widened(float margin) const { return {low - splat(margin), high + splat(margin)}; }
    Lanes center() const { return splat(0.5f) * low + splat(0.5f) * high; }
};

/// Half the surface area; what the surface-area heuristic is proportional to. 0 for an empty box.
inline float half_area(const Box& box) {
    if (box.is_empty()) return 0.0f;
    const Lanes size = box.high - box.low;
    return size[0] * size[1] + size[1] * size[2] + size[2] * size[0];
}

} // namespace onde::accel
