// Where a triangle lies, as its TriangleSurface says.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace onde {

struct TrianglePlane {
    glm::vec3 normal;
    float offset;
    uint32_t reach; // the exponent of the next power of two, as floats have it
};

/// `orientation` is -1 where the corners are seen in a mirror, else 1.
TrianglePlane triangle_plane(const glm::vec3 (&p)[3], float orientation);

} // namespace onde
