// Lights without geometry. Anything with an emissive material is a light as well. The `group` of a
// light is a name that others may have too: films can have the light of each group by itself.
#pragma once

#include "image/image.h"
#include "scene/fields.h"

#include <glm/glm.hpp>

#include <numbers>
#include <optional>
#include <string>

namespace onde {

struct PointLight {
    glm::vec3 position{0.0f};
    glm::vec3 intensity{1.0f}; ///< W/sr
    std::string group{};
};

/// What a light without its radiometric key is taken to mean, for the documentation.
inline constexpr std::string_view FROM_CHAPTER = "from `chapter_intensity`";

constexpr auto fields_of(TypeTag<PointLight>) {
    return std::tuple{
        field("position", &PointLight::position, "", {.form = Form::point, .required = true}),
        field("intensity", &PointLight::intensity, "W/sr",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = FROM_CHAPTER}),
        field("group", &PointLight::group, GROUP_MEANING, GROUP_RULES)};
}

/// Shines into a cone: with all its intensity into an inner one, with less toward the rim.
struct SpotLight {
    glm::vec3 position{0.0f};
    glm::vec3 back{0.0f, 1.0f, 0.0f};                     ///< unit, against the way it shines
    glm::vec3 intensity{1.0f};                            ///< W/sr
    float half_angle = 0.25f * std::numbers::pi_v<float>; ///< radians, of the cone
    float inner_angle = 0.0f; ///< radians, half; at least half_angle: alike everywhere
    std::string group{};
};

constexpr auto fields_of(TypeTag<SpotLight>) {
    return std::tuple{
        field("position", &SpotLight::position, "", {.form = Form::point, .required = true}),
        field("direction", &SpotLight::back, "the way it shines",
              {.form = Form::travel, .required = true}),
        field("intensity", &SpotLight::intensity, "W/sr",
              {.range = NOT_NEGATIVE, .form = Form::color}),
        field("half_angle", &SpotLight::half_angle, "of the cone",
              {.range = {.low = 0.1, .high = 180}, .form = Form::degrees}),
        field("inner_angle", &SpotLight::inner_angle,
              "of the cone in which it has all its intensity",
              {.range = {.low = 0, .high = 180}, .form = Form::degrees}),
        field("group", &SpotLight::group, GROUP_MEANING, GROUP_RULES)};
}

struct DirectionalLight {
    glm::vec3 to_light{0.0f, 1.0f, 0.0f}; ///< unit, pointing from the scene toward the light
    glm::vec3 irradiance{1.0f};           ///< on a surface facing the light
    std::string group{};
};

constexpr auto fields_of(TypeTag<DirectionalLight>) {
    return std::tuple{field("direction", &DirectionalLight::to_light, "the way the light travels",
                            {.form = Form::travel, .required = true}),
                      field("irradiance", &DirectionalLight::irradiance,
                            "W/m^2 on a surface facing the light",
                            {.range = NOT_NEGATIVE, .form = Form::color, .absent = FROM_CHAPTER}),
                      field("group", &DirectionalLight::group, GROUP_MEANING, GROUP_RULES)};
}

inline PointLight placed(PointLight light, const glm::mat4& transform) {
    light.position = glm::vec3(transform * glm::vec4(light.position, 1.0f));
    return light;
}
inline DirectionalLight placed(DirectionalLight light, const glm::mat4& transform) {
    light.to_light = glm::normalize(glm::mat3(transform) * light.to_light);
    return light;
}

inline SpotLight placed(SpotLight light, const glm::mat4& transform) {
    light.position = glm::vec3(transform * glm::vec4(light.position, 1.0f));
    light.back = glm::normalize(glm::mat3(transform) * light.back);
    return light;
}

/// The lists of lights without geometry, each once: LIST(Type, list, words). What goes through the
/// lights of a scene goes by this list.
#define LIGHT_LISTS(LIST)                                                                          \
    LIST(PointLight, point_lights, "point light")                                                  \
    LIST(SpotLight, spot_lights, "spot light")                                                     \
    LIST(DirectionalLight, directional_lights, "directional light")

/// Light from infinity: `radiance` times the equirectangular `map` if there is one.
/// Map row 0 is straight up (+Y); the centre column is -Z; +X is to the right of it.
/// rotation (radians) turns the map counter-clockwise about +Y seen from above.
struct Environment {
    glm::vec3 radiance{0.0f};
    std::optional<Image> map; ///< 3 channels
    float rotation = 0.0f;
    std::optional<float> ground{};
    std::string group{}; ///< of lights
};

constexpr auto fields_of(TypeTag<Environment>) {
    return std::tuple{field("radiance", &Environment::radiance, "multiplies the map",
                            {.range = NOT_NEGATIVE, .form = Form::color, .absent = "`1`"}),
                      LoaderKey{"map", "equirectangular picture (`.hdr`, `.exr`, `.png`)",
                                "the top row is +Y, the centre is -Z, +X to the right of it", ""},
                      field_without_key(&Environment::map, "map"),
                      field("rotation", &Environment::rotation,
                            "counter-clockwise about +Y seen from above", {.form = Form::degrees}),
                      field("ground", &Environment::ground,
                            "y of a plane that shows nothing but the shadow that the scene throws "
                            "in this light and a faint reflection of it",
                            {.form = Form::height, .absent = "no ground"}),
                      field("group", &Environment::group, GROUP_MEANING, GROUP_RULES)};
}

} // namespace onde
