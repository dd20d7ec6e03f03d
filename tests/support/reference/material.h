// Material records, compact, and their values at a point.
#pragma once

#include "scene/scene.h"
#include "support/reference/albedo.h"
#include "support/reference/geometry.h"
#include "support/reference/texture.h"

#include <span>

namespace onde::reference {

/// What scene.h's Material says, in 80 bytes and without its name.
struct MaterialRecord {
    glm::vec3 base_color;
    float roughness;
    glm::vec3 emission;
    float metallic;
    float ior;
    float normal_scale;
    MaterialKind kind;
    bool two_sided;
    bool textured; ///< base colour or roughness and metallic
    int32_t base_color_texture, metallic_roughness_texture, emission_texture, normal_texture;

    const AlbedoTable* albedos; ///< of its microfacets; null where it is smooth or has none
    float mean_transmission;    ///< of glass

    explicit MaterialRecord(const Material& material);
    bool emits() const { return emission != glm::vec3(0.0f); }
};

/// Materials and textures of a scene.
class Appearance {
  public:
    explicit Appearance(const Scene& scene);

    const MaterialRecord& material(uint32_t index) const { return materials_[index]; }
    /// The record with its textures multiplied in.
    MaterialRecord at(const MaterialRecord& material, const glm::vec2& uv) const;
    /// Radiance emitted toward a viewer on the front (or back) side.
    glm::vec3 emission(const MaterialRecord& material, const glm::vec2& uv, bool front) const;
    /// Over the whole texture; zero only where nothing is emitted.
    glm::vec3 mean_emission(uint32_t material) const { return mean_emission_[material]; }
    /// The shading normal after the normal map, on the same side as `normal`.
    glm::vec3 mapped_normal(const MaterialRecord& material, const glm::vec2& uv,
                            const Tangents& tangents, const glm::vec3& normal) const;

  private:
    std::vector<MaterialRecord> materials_;
    std::vector<TextureMap> textures_;
    std::vector<glm::vec3> mean_emission_; ///< per material
};

} // namespace onde::reference
