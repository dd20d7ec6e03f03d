// Directional albedos: how much of white light along one direction a rough boundary of GGX
// microfacets scatters at once. The rest is lost between them.
#pragma once

#include "support/reference/microfacet.h"

#include <array>
#include <functional>
#include <vector>

namespace onde::reference {

/// Two albedos by roughness and by the cosine of the direction, in equal steps of the roughness
/// and of the cosine's square root.
class AlbedoTable {
  public:
    struct Row {
        static constexpr uint32_t COLUMNS = 64;
        std::array<glm::vec2, COLUMNS> entries;
        glm::vec2 mean; ///< over the hemisphere, weighted by the cosine

        glm::vec2 at(float cosine) const; ///< that of 0 where it is negative
        glm::vec2 integrated() const;     ///< what `mean` is
    };
    /// Both albedos of a direction, cosine and alpha > 0.
    using Pair = std::function<glm::vec2(float cosine, float alpha)>;

    explicit AlbedoTable(const Pair& albedos);

    static constexpr uint32_t ROWS = 48;
    const Row* rows() const { return rows_.data(); }

  private:
    std::vector<Row> rows_;
};

/// A table at one roughness.
class Albedos {
  public:
    Albedos() = default; ///< of a mirror: reflection_albedos() without roughness
    Albedos(const AlbedoTable& table, float roughness);

    glm::vec2 at(float cosine) const {
        if (!row_) return {1.0f, schlick_weight(cosine)};
        return glm::mix(row_[0].at(cosine), row_[1].at(cosine), fraction_);
    }
    glm::vec2 mean() const {
        if (!row_) return {1.0f, 1.0f / 21.0f};
        return glm::mix(row_[0].mean, row_[1].mean, fraction_);
    }

  private:
    const AlbedoTable::Row* row_ = nullptr;
    float fraction_ = 0.0f; ///< of the way to the next row
};

/// Reflection: of white light, and of light that is weighed by Schlick's (1 - cosine)^5.
const AlbedoTable& reflection_albedos();
/// Reflection and refraction together, from outside and from inside. Kept for each index.
const AlbedoTable& glass_albedos(float ior);

/// The share of diffuse light from outside that a smooth boundary lets in. Needs no table.
float mean_transmission_into(float ior);

} // namespace onde::reference
