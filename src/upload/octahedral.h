// Unit vectors in 32 bits. The decoder is kernels/math/elementary.h.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace onde {

/// Two signed 16-bit octahedral coordinates, x low (Cigolle et al. 2014, A Survey of Efficient
/// Representations for Independent Unit Vectors). The zero vector is taken as +Z. Error below
/// 7e-5 radians.
uint32_t encode_octahedral(glm::vec3 unit);

/// The vector at length 1, or `fallback` where that can't be.
glm::vec3 unit_or(glm::vec3 v, glm::vec3 fallback);

} // namespace onde
