#include "scene/phong.h"

#include "scene/load.h"

#include <algorithm>
#include <numbers>

namespace onde {
namespace {

constexpr float PI = std::numbers::pi_v<float>;

float largest(glm::vec3 v) {
    return std::max({v.x, v.y, v.z});
}

float exponent_of(float roughness) {
    const float alpha = std::max(roughness * roughness, 0.01f);
    return std::clamp(2 / (alpha * alpha) - 2, 0.0f, 1000.0f);
}

/// Lets `strength` and the radiometric `measure` = factor * strength follow from each other.
void complete(glm::vec3& strength, glm::vec3& measure, float factor, DerivedLights& derived) {
    if (largest(strength) <= 0.0f) {
        strength = measure / factor;
        ++derived.strengths;
    } else if (largest(measure) <= 0.0f) {
        measure = strength * factor;
        ++derived.measures;
    }
}

float area(const AreaLight& light) {
    if (light.kind == AreaLightKind::sphere) return PI * light.radius * light.radius; // its disk
    const float parallelogram = glm::length(glm::cross(light.edge1, light.edge2));
    return light.kind == AreaLightKind::disk ? PI * parallelogram : parallelogram;
}

glm::vec3 middle(const AreaLight& light) {
    return light.kind == AreaLightKind::rectangle
               ? light.position + 0.5f * (light.edge1 + light.edge2)
               : light.position;
}

} // namespace

Phong phong_of(const Material& m) {
    Phong p;
    p.exponent = exponent_of(m.roughness);
    switch (m.kind) {
    case MaterialKind::diffuse:
    case MaterialKind::phong:
        p.exponent = Phong().exponent;
        break;
    case MaterialKind::conductor:
        p.reflection = largest(m.base_color);
        p.ambient = p.diffuse = 0.0f;
        p.specular = 1.0f;
        break;
    case MaterialKind::dielectric:
        p.transmission = largest(m.base_color);
        p.ambient = p.diffuse = 0.0f;
        p.specular = 0.5f;
        break;
    case MaterialKind::metallic_roughness:
        p.ambient = p.diffuse = 1.0f - m.metallic;
        p.specular = 0.25f + 0.75f * m.metallic;
        p.reflection = m.metallic * (1.0f - m.roughness) * largest(m.base_color);
        break;
    }
    return p;
}

Material path_material(const Material& material) {
    Material m = material;
    if (m.kind != MaterialKind::phong) return m;
    const Phong& p = m.phong;
    if (p.transmission > 0.5f) {
        m.kind = MaterialKind::dielectric;
        m.base_color = glm::vec3(p.transmission);
    } else if (p.reflection > 0.5f) {
        m.kind = MaterialKind::conductor;
        m.base_color = glm::vec3(p.reflection);
    } else {
        m.kind = MaterialKind::diffuse;
        m.base_color *= std::min(p.diffuse, 1.0f);
    }
    m.roughness = m.kind == MaterialKind::diffuse ? 1.0f : 0.0f;
    return m;
}

void complete_lights(Scene& scene) {
    if (scene.point_lights.empty() && scene.directional_lights.empty() && scene.area_lights.empty())
        return;
    scene.derived_lights = {};
    const SceneBounds bounds = scene_bounds(scene);
    const glm::vec3 center = 0.5f * bounds.low + 0.5f * bounds.high;
    const auto distance2 = [&](glm::vec3 from) {
        const glm::vec3 d = from - center;
        return std::max(glm::dot(d, d), 1e-12f);
    };
    for (PointLight& light : scene.point_lights)
        complete(light.strength, light.intensity, PI * distance2(light.position),
                 scene.derived_lights);
    for (DirectionalLight& light : scene.directional_lights)
        complete(light.strength, light.irradiance, PI, scene.derived_lights);
    for (AreaLight& light : scene.area_lights)
        complete(light.strength, scene.materials[light.material].emission,
                 PI * distance2(middle(light)) / std::max(area(light), 1e-12f),
                 scene.derived_lights);
}

} // namespace onde
