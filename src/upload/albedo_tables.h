// The tables of directional albedos that a scene's materials need. See kernels/shared/albedo.h for
// what lies where.
#pragma once

#include "scene/material.h"
#include "shared/albedo.h"

#include <cstdint>
#include <span>
#include <vector>

namespace onde {

/// The tables that a scene's materials need, in one buffer.
class AlbedoTables {
  public:
    /// The first word of the table of glass of an index of refraction, outside over inside. Where
    /// there are very many tables, that of the nearest index.
    uint32_t glass(float ior, Distribution distribution = Distribution::ggx);
    /// The tables of reflection, of sheen, of reflection with a grain and by Beckmann's
    /// microfacets, then those of glass. Those that nothing asks for say that nothing is lost, for
    /// kernels that can do more than the scene asks.
    std::vector<uint32_t> words() &&;
    /// Asks for the table of reflection.
    void reflection() { used_ = true; }
    /// Asks for that of sheen too.
    void sheen() { used_ = sheen_ = true; }
    /// Asks for that with a grain too.
    void grain() { used_ = grain_ = true; }
    /// Asks for that of Beckmann's microfacets too.
    void beckmann() { used_ = beckmann_ = true; }

  private:
    struct Glass {
        float ior;
        Distribution distribution;
    };

    bool used_ = false, sheen_ = false, grain_ = false, beckmann_ = false;
    std::vector<Glass> glasses_;
};

/// The same interpolation as the kernels': the two numbers of a direction, each in [0, 1], from the
/// table that starts at `table`.
struct AlbedoNumbers {
    double first, second;
};
AlbedoNumbers albedo_numbers(std::span<const uint32_t> table, double cosine, double alpha);

} // namespace onde
