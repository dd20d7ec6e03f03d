#include "support/reference/material.h"

namespace onde::reference {

static const AlbedoTable* albedos_of(const Material& m) {
    if (m.kind == MaterialKind::diffuse || m.roughness * m.roughness < SMOOTH_ALPHA) return nullptr;
    if (m.kind != MaterialKind::dielectric) return &reflection_albedos();
    return std::abs(m.ior - 1.0f) < EQUAL_INDICES ? nullptr : &glass_albedos(m.ior);
}

MaterialRecord::MaterialRecord(const Material& m)
    : base_color(m.base_color), roughness(m.roughness), emission(m.emission), metallic(m.metallic),
      ior(m.ior), normal_scale(m.normal_scale), kind(m.kind), two_sided(m.two_sided),
      textured(m.base_color_texture != NO_TEXTURE || m.metallic_roughness_texture != NO_TEXTURE),
      base_color_texture(m.base_color_texture),
      metallic_roughness_texture(m.metallic_roughness_texture),
      emission_texture(m.emission_texture), normal_texture(m.normal_texture),
      albedos(albedos_of(m)),
      mean_transmission(m.kind == MaterialKind::dielectric ? mean_transmission_into(m.ior) : 0.0f) {
}

Appearance::Appearance(const Scene& scene) {
    for (const Material& material : scene.materials) materials_.emplace_back(material);
    for (const Texture& texture : scene.textures)
        textures_.emplace_back(texture, image_of(scene.textures, texture));
    for (const MaterialRecord& m : materials_) {
        const bool uniform = !m.emits() || m.emission_texture == NO_TEXTURE;
        const glm::vec3 mean =
            uniform ? glm::vec3(1.0f) : textures_[size_t(m.emission_texture)].mean();
        mean_emission_.push_back(m.emission * mean);
    }
}

MaterialRecord Appearance::at(const MaterialRecord& material, const glm::vec2& uv) const {
    MaterialRecord m = material;
    if (m.base_color_texture != NO_TEXTURE)
        m.base_color *= textures_[size_t(m.base_color_texture)].sample(uv);
    if (m.metallic_roughness_texture != NO_TEXTURE) {
        const glm::vec3 texel = textures_[size_t(m.metallic_roughness_texture)].sample(uv);
        m.roughness *= texel.g;
        m.metallic *= texel.b;
    }
    return m;
}

glm::vec3 Appearance::emission(const MaterialRecord& m, const glm::vec2& uv, bool front) const {
    if (!front && !m.two_sided) return glm::vec3(0.0f);
    if (m.emission_texture == NO_TEXTURE) return m.emission;
    return m.emission * textures_[size_t(m.emission_texture)].sample(uv);
}

glm::vec3 Appearance::mapped_normal(const MaterialRecord& m, const glm::vec2& uv,
                                    const Tangents& tangents, const glm::vec3& normal) const {
    const glm::vec3 along = tangents.dpdu - normal * glm::dot(normal, tangents.dpdu);
    const float length = glm::length(along);
    if (!(length > 0.0f)) return normal;
    const glm::vec3 tangent = along / length;
    // v runs downward and the map's Y upward: the bitangent points against dp/dv.
    glm::vec3 bitangent = glm::cross(normal, tangent);
    if (glm::dot(bitangent, tangents.dpdv) > 0.0f) bitangent = -bitangent;
    glm::vec3 n = textures_[size_t(m.normal_texture)].sample(uv) * 2.0f - 1.0f;
    n.x *= m.normal_scale, n.y *= m.normal_scale;
    return glm::normalize(tangent * n.x + bitangent * n.y + normal * n.z);
}

} // namespace onde::reference
