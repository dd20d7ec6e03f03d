// Vectors into the words of records.
#pragma once

#include <glm/glm.hpp>

namespace onde {

template <glm::length_t N>
void copy(float (&to)[N], const glm::vec<N, float>& from) {
    for (glm::length_t k = 0; k < N; k++) to[k] = from[k];
}

} // namespace onde
