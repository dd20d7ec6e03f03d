#include "scene/phong.h"

#include "scene/load.h"

#include <algorithm>
#include <limits>
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

glm::vec3 in_range(glm::vec3 v) {
    return glm::min(v, glm::vec3(std::numeric_limits<float>::max()));
}

/// Lets the chapter's `intensity` and the radiometric `measure` = factor * intensity follow from
/// each other; what no float can hold is as large as one can be.
void complete(glm::vec3& intensity, glm::vec3& measure, float factor, DerivedLights& derived) {
    if (largest(intensity) <= 0.0f) {
        intensity = in_range(measure / factor);
        ++derived.intensities;
    } else if (largest(measure) <= 0.0f) {
        measure = in_range(intensity * factor);
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
    case MaterialKind::unlit: // shows its colour as it would emission
        p.ambient = p.diffuse = 0.0f;
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
        p.transmission = (1.0f - m.metallic) * m.transmission * largest(m.base_color);
        p.ambient = p.diffuse = (1.0f - m.metallic) * (1.0f - m.transmission);
        p.specular = 0.25f + 0.75f * m.metallic;
        p.reflection = m.metallic * (1.0f - m.roughness) * largest(m.base_color);
        break;
    }
    return p;
}

Phong phong_of(const Scene& scene, uint32_t material) {
    const auto stated = scene.chapter.phong.find(material);
    return stated == scene.chapter.phong.end() ? phong_of(scene.materials[material])
                                               : stated->second;
}

static glm::vec3 stated_at(const std::map<uint32_t, glm::vec3>& intensities, uint32_t light) {
    const auto stated = intensities.find(light);
    return stated == intensities.end() ? glm::vec3(0.0f) : stated->second;
}

glm::vec3 point_intensity(const Scene& scene, uint32_t light) {
    return stated_at(scene.chapter.intensities.point_lights, light);
}

glm::vec3 directional_intensity(const Scene& scene, uint32_t light) {
    return stated_at(scene.chapter.intensities.directional_lights, light);
}

Material path_material(const Scene& scene, uint32_t material) {
    Material m = scene.materials[material];
    if (m.kind != MaterialKind::phong) return m;
    const Phong p = phong_of(scene, material);
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
    ChapterScene& chapter = scene.chapter;
    if (scene.point_lights.empty() && scene.directional_lights.empty() &&
        chapter.area_lights.empty())
        return;
    chapter.derived_lights = {};
    const SceneBounds bounds = scene_bounds(scene);
    const glm::vec3 center = 0.5f * bounds.low + 0.5f * bounds.high;
    const auto distance2 = [&](glm::vec3 from) {
        const glm::vec3 d = from - center;
        return std::max(glm::dot(d, d), 1e-12f);
    };
    for (uint32_t i = 0; i < scene.point_lights.size(); ++i) {
        PointLight& light = scene.point_lights[i];
        glm::vec3& intensity = chapter.intensities.point_lights.try_emplace(i, 0.0f).first->second;
        complete(intensity, light.intensity, PI * distance2(light.position),
                 chapter.derived_lights);
    }
    for (uint32_t i = 0; i < scene.directional_lights.size(); ++i)
        complete(chapter.intensities.directional_lights.try_emplace(i, 0.0f).first->second,
                 scene.directional_lights[i].irradiance, PI, chapter.derived_lights);
    for (AreaLight& light : chapter.area_lights)
        complete(light.intensity, scene.materials[light.material].emission,
                 PI * distance2(middle(light)) / std::max(area(light), 1e-12f),
                 chapter.derived_lights);
}

} // namespace onde
