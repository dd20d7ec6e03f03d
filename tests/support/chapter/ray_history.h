// What the parts of the recursion share.
#pragma once

#include "support/chapter/trace.h"

namespace onde::chapter {

/// What a ray has behind it.
struct Tracer::RayHistory {
    uint32_t depth;               ///< of the node at its end; the camera ray's is 1
    glm::dvec3 product;           ///< of all factors
    const Wavelength* wavelength; ///< null: white
    uint32_t sample;
    uint64_t* structure;

    void mark(uint64_t choice) const {
        *structure = (*structure ^ (choice + 0x9e3779b97f4a7c15u)) * 0xff51afd7ed558ccdu;
        *structure ^= *structure >> 32;
    }
};

/// v mirrored about the unit vector n.
inline glm::dvec3 mirror(const glm::dvec3& v, const glm::dvec3& n) {
    return 2 * glm::dot(n, v) * n - v;
}

} // namespace onde::chapter
