// Lights without geometry. Anything with an emissive material is a light as well. The `group` of a
// light is a name that others may have too: films can have the light of each group by itself.
#pragma once

#include "image/image.h"
#include "scene/fields.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

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

/// How bright a light is in each direction, in candela, at the nodes of a grid: in rows of equal
/// steps of the angle to its axis, the first along it and the last against it, of equal steps of
/// the angle around it.
struct LightProfile {
    uint32_t rows = 1, columns = 1; ///< of cells: there is one row of nodes more
    std::vector<float> candela{1.0f, 1.0f};

    float node(uint32_t row, uint32_t column) const {
        return candela[size_t(row) * columns + column % columns];
    }
};

inline uint64_t bytes_of(const LightProfile& profile) {
    return profile.candela.size() * sizeof(float);
}

inline constexpr uint32_t MOST_PROFILE_STEPS = 1440; ///< around its axis; half as many along it

constexpr auto fields_of(TypeTag<LightProfile>) {
    return std::tuple{field_without_key(&LightProfile::rows, "rows",
                                        {.range = {.low = 1, .high = MOST_PROFILE_STEPS / 2}}),
                      field_without_key(&LightProfile::columns, "columns",
                                        {.range = {.low = 1, .high = MOST_PROFILE_STEPS}}),
                      field_without_key(&LightProfile::candela, "candela")};
}

/// A lamp without size that shines as has been measured of it.
struct PhotometricLight {
    glm::vec3 position{0.0f};
    glm::vec3 back{0.0f, 1.0f, 0.0f};  ///< unit, against the profile's axis
    glm::vec3 start{1.0f, 0.0f, 0.0f}; ///< where angles around the axis begin; not along it
    glm::vec3 intensity{1.0f};         ///< times the profile
    LightProfile profile{};
    std::string group{};
};

/// The lumens of a watt that is seen best, by which candela become W/sr.
inline constexpr double LUMENS_PER_WATT = 683.0;

constexpr auto fields_of(TypeTag<PhotometricLight>) {
    using P = PhotometricLight;
    return std::tuple{
        field("position", &P::position, "", {.form = Form::point, .required = true}),
        LoaderKey{"ies", "a file of IES LM-63, photometry of type C",
                  "683 of its candela are 1 W/sr", ""},
        field_without_key(&P::profile, "profile"),
        field("direction", &P::back, "of the file's vertical angle 0", {.form = Form::travel}),
        field("start", &P::start, "of its horizontal angle 0, as far as that lies across"),
        field("intensity", &P::intensity, "multiplies the file's",
              {.range = NOT_NEGATIVE, .form = Form::color}),
        field("group", &P::group, GROUP_MEANING, GROUP_RULES)};
}

/// Light from a disk at infinity that is seen alike everywhere.
struct DirectionalLight {
    glm::vec3 to_light{0.0f, 1.0f, 0.0f}; ///< unit, pointing from the scene toward the light
    glm::vec3 irradiance{1.0f};           ///< on a surface facing the light
    float angle = 0.0f;                   ///< radians across, of the disk
    std::string group{};
};

/// Radians. Disks below that have no size: floats could not tell directions in them apart.
inline constexpr float LEAST_SUN_ANGLE = 0.01f * std::numbers::pi_v<float> / 180.0f;

/// Whether rays can find it.
inline bool has_size(const DirectionalLight& light) {
    return light.angle >= LEAST_SUN_ANGLE;
}

/// Directions that no ray can find.
inline size_t count_without_size(const std::vector<DirectionalLight>& lights) {
    return size_t(std::ranges::count_if(lights, [](const auto& l) { return !has_size(l); }));
}

constexpr auto fields_of(TypeTag<DirectionalLight>) {
    return std::tuple{field("direction", &DirectionalLight::to_light, "the way the light travels",
                            {.form = Form::travel, .required = true}),
                      field("irradiance", &DirectionalLight::irradiance,
                            "W/m^2 on a surface facing the light",
                            {.range = NOT_NEGATIVE, .form = Form::color, .absent = FROM_CHAPTER}),
                      field("angle", &DirectionalLight::angle,
                            "across, of the disk as which it is seen; the sun has 0.53",
                            {.range = {.low = 0, .high = 180}, .form = Form::degrees}),
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

/// The profile in a mirror that its axis and its first column lie in.
inline LightProfile mirrored(const LightProfile& profile) {
    LightProfile other = profile;
    for (uint32_t row = 0; row <= profile.rows; ++row)
        for (uint32_t column = 0; column < profile.columns; ++column)
            other.candela[size_t(row) * profile.columns + column] =
                profile.node(row, profile.columns - column);
    return other;
}

inline PhotometricLight placed(PhotometricLight light, const glm::mat4& transform) {
    if (glm::determinant(glm::mat3(transform)) < 0.0f) light.profile = mirrored(light.profile);
    light.position = glm::vec3(transform * glm::vec4(light.position, 1.0f));
    light.back = glm::normalize(glm::mat3(transform) * light.back);
    light.start = glm::mat3(transform) * light.start;
    return light;
}

/// The lists of lights without geometry, each once: LIST(Type, list, words). What goes through the
/// lights of a scene goes by this list.
#define LIGHT_LISTS(LIST)                                                                          \
    LIST(PointLight, point_lights, "point light")                                                  \
    LIST(SpotLight, spot_lights, "spot light")                                                     \
    LIST(PhotometricLight, photometric_lights, "photometric light")                                \
    LIST(DirectionalLight, directional_lights, "directional light")

/// A cloudless sky by day; what it looks like is told by daylight.h.
struct Daylight {
    float elevation = 0.25f * std::numbers::pi_v<float>; ///< radians, of the sun
    float azimuth = 0.0f;                                ///< radians, from -Z toward +X
    float turbidity = 3.0f;
    glm::vec3 ground_albedo{0.2f};
    bool sun = true;
};

constexpr auto fields_of(TypeTag<Daylight>) {
    using D = Daylight;
    return std::tuple{
        field("elevation", &D::elevation, "of the sun above the horizon",
              {.range = {.low = 0, .high = 90}, .form = Form::degrees}),
        field("azimuth", &D::azimuth, "of the sun, clockwise seen from above: 0 is -Z, 90 is +X",
              {.form = Form::degrees}),
        field("turbidity", &D::turbidity, "of the air: 2 is clear, 6 warm and moist, 10 hazy",
              {.range = {.low = 2, .high = 10}}),
        field("ground_albedo", &D::ground_albedo, "of what lies below the horizon",
              {.range = UNIT, .form = Form::color}),
        field("sun", &D::sun, "whether the sun itself is there, a light of 0.53 degrees")};
}

/// Light from infinity: `radiance` times the equirectangular `map` if there is one.
/// Map row 0 is straight up (+Y); the centre column is -Z; +X is to the right of it.
/// rotation (radians) turns the map counter-clockwise about +Y seen from above.
struct Environment {
    glm::vec3 radiance{0.0f};
    std::optional<Image> map; ///< 3 channels
    float rotation = 0.0f;
    std::optional<float> ground{};
    std::string group{};           ///< of lights
    std::optional<Daylight> sky{}; ///< of which loading draws the map
};

constexpr auto fields_of(TypeTag<Environment>) {
    return std::tuple{field("radiance", &Environment::radiance, "multiplies the map",
                            {.range = NOT_NEGATIVE, .form = Form::color, .absent = "`1`"}),
                      LoaderKey{"map", "equirectangular picture (`.hdr`, `.exr`, `.png`)",
                                "the top row is +Y, the centre is -Z, +X to the right of it", ""},
                      field_without_key(&Environment::map, "map"),
                      field("sky", &Environment::sky, "[daylight](#daylight) instead of a map",
                            {.absent = "none"}),
                      field("rotation", &Environment::rotation,
                            "counter-clockwise about +Y seen from above", {.form = Form::degrees}),
                      field("ground", &Environment::ground,
                            "y of a plane that shows nothing but the shadow that the scene throws "
                            "in this light and a faint reflection of it",
                            {.form = Form::height, .absent = "no ground"}),
                      field("group", &Environment::group, GROUP_MEANING, GROUP_RULES)};
}

} // namespace onde
