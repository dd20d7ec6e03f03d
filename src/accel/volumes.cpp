#include "accel/volumes.h"

#include "accel/volume_rounding.h"

namespace onde {

using namespace accel;

const std::array<glm::vec3, MANY_SLABS> SLAB_NORMALS{{{1, 0, 0},
                                                      {0, 1, 0},
                                                      {0, 0, 1},
                                                      {1, 1, 1},
                                                      {1, 1, -1},
                                                      {1, -1, 1},
                                                      {-1, 1, 1},
                                                      {1, 1, 0},
                                                      {1, -1, 0},
                                                      {1, 0, 1},
                                                      {1, 0, -1},
                                                      {0, 1, 1},
                                                      {0, 1, -1}}};

BoxVolume fit_box(std::span<const glm::vec3> points) {
    glm::vec3 low = points[0], high = points[0];
    for (const glm::vec3& point : points) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    return {{low.x, low.y, low.z}, {high.x, high.y, high.z}, reach_of(points), 0};
}

SlabsVolume fit_slabs(std::span<const glm::vec3> points) {
    SlabsVolume slabs{};
    for (size_t k = 0; k < SLAB_NORMALS.size(); ++k) {
        const Cover covered = cover(points, glm::dvec3(SLAB_NORMALS[k]));
        slabs.low[k] = round_down(covered.low);
        slabs.high[k] = round_up(covered.high);
    }
    slabs.reach = reach_of(points);
    return slabs;
}

} // namespace onde
