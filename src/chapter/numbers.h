// Random numbers that are the same everywhere.
#pragma once

#include <glm/glm.hpp>

#include <cstddef>
#include <cstdint>

namespace onde {

/// Numbers from a counter: Steele, Lea and Flood, "Fast splittable pseudorandom number generators",
/// 2014.
class Numbers {
  public:
    explicit Numbers(uint64_t seed) : state_(seed) {}

    uint64_t next() {
        uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
        z = (z ^ z >> 27) * 0x94d049bb133111ebu;
        return z ^ z >> 31;
    }
    uint32_t below(size_t count) { return uint32_t((next() >> 32) * count >> 32); }
    float unit() { return float(next() >> 40) * 0x1p-24f; }
    glm::vec3 in_cube() {
        const float x = unit(), y = unit(), z = unit();
        return 2.0f * glm::vec3(x, y, z) - 1.0f;
    }

  private:
    uint64_t state_;
};

} // namespace onde
