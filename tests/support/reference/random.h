// Independent random numbers: one PCG stream per pixel and sample.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>

namespace onde::reference {

/// PCG-XSH-RR 64/32 (O'Neill 2014, "PCG: A Family of Simple Fast Space-Efficient Statistically Good
/// Algorithms for Random Number Generation").
class Random {
  public:
    Random(uint32_t seed, uint32_t pixel, uint32_t sample)
        : state_(mix(mix(uint64_t(seed) << 32 | pixel) + sample)) {}

    /// Uniform in [0, 1).
    float next() {
        const uint64_t old = state_;
        state_ = old * 6364136223846793005u + 1442695040888963407u;
        const auto bits = uint32_t(((old >> 18) ^ old) >> 27);
        const auto turn = uint32_t(old >> 59);
        const uint32_t value = bits >> turn | bits << (-turn & 31);
        return float(value >> 8) * 0x1p-24f;
    }
    glm::vec2 next2() {
        const float x = next();
        return {x, next()};
    }

  private:
    /// The finaliser of SplitMix64 (Steele et al. 2014), so that neighbours start far apart.
    static uint64_t mix(uint64_t x) {
        x += 0x9e3779b97f4a7c15u;
        x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
        x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
        return x ^ (x >> 31);
    }
    uint64_t state_;
};

} // namespace onde::reference
