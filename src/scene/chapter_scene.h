// What the textbook's chapter adds to a scene: Phong's numbers, its own measure of light, what its
// integrators are asked, and what a picture is to show. The integrators that follow light read
// nothing of it.
#pragma once

#include "core/enum_words.h"
#include "scene/fields.h"
#include "scene/lesson.h"
#include "scene/light.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <map>
#include <optional>

namespace onde {

/// What the Whitted integrator does at a surface; base_color is the chapter's Co, Material::ior its
/// n2 / n1. docs/whitted.md says how each number is used, and what other kinds are mapped to.
struct Phong {
    float ambient = 1.0f, diffuse = 1.0f, specular = 0.0f; ///< weights of the three parts
    float exponent = 20.0f;                                ///< of the specular part
    float reflection = 0.0f;     ///< factor of light that comes along the mirror direction
    float transmission = 0.0f;   ///< factor of light that comes through
    std::optional<float> abbe{}; ///< Abbe number V_d of the index; without it, no dispersion
};

/// Keys of [[material]], beside those of Material.
constexpr auto fields_of(TypeTag<Phong>) {
    using P = Phong;
    return std::tuple{field("ambient", &P::ambient, "weight of the ambient part",
                            {.range = NOT_NEGATIVE, .absent = "`1`, but by kind"}),
                      field("diffuse", &P::diffuse, "weight of the diffuse part",
                            {.range = NOT_NEGATIVE, .absent = "`1`, but by kind"}),
                      field("specular", &P::specular, "weight of the specular part",
                            {.range = NOT_NEGATIVE, .absent = "`0`, but by kind"}),
                      field("exponent", &P::exponent, "of the specular part",
                            {.range = NOT_NEGATIVE, .absent = "`20`, but by kind"}),
                      field("reflection", &P::reflection,
                            "factor of light along the mirror direction",
                            {.range = UNIT, .absent = "`0`, but by kind"}),
                      field("transmission", &P::transmission, "factor of light that comes through",
                            {.range = UNIT, .absent = "`0`, but by kind"}),
                      field("abbe", &P::abbe, "Abbe number of the index",
                            {.range = POSITIVE, .absent = "no dispersion"})};
}

enum class AreaLightKind : uint32_t { rectangle, disk, sphere };

constexpr auto enum_words(AreaLightKind) {
    return std::array{EnumWord{AreaLightKind::rectangle, "rectangle"},
                      EnumWord{AreaLightKind::disk, "disk"},
                      EnumWord{AreaLightKind::sphere, "sphere"}};
}

/// An extended source as the Whitted integrator sees it. The geometry that emits radiance is among
/// the scene's meshes, spheres and shapes.
struct AreaLight {
    AreaLightKind kind = AreaLightKind::rectangle;
    glm::vec3 position{0.0f};           ///< rectangle: a corner; disk, sphere: the centre
    glm::vec3 edge1{0.0f}, edge2{0.0f}; ///< rectangle: its edges; disk: two radii
    float radius = 0.0f;                ///< sphere
    uint32_t two_sided = 0;             ///< else light leaves only toward cross(edge1, edge2)
    uint32_t material = 0;              ///< of the geometry
    uint32_t samples = 4;               ///< a grid of samples x samples shadow rays
    glm::vec3 intensity{0.0f};          ///< the chapter's is * Cs
};

constexpr auto fields_of(TypeTag<AreaLight>) {
    using L = AreaLight;
    return std::tuple{
        field_without_key(&L::kind, "kind"),
        field_without_key(&L::position, "position"),
        field_without_key(&L::edge1, "first edge"),
        field_without_key(&L::edge2, "second edge"),
        field_without_key(&L::radius, "radius", {.range = NOT_NEGATIVE}),
        field_without_key(&L::two_sided, "two-sidedness"),
        field_without_key(&L::material, "material", {.form = Form::material}),
        field("samples", &L::samples, "side of the grid of shadow rays that Whitted sends to it",
              {.range = {.low = 1, .high = 64}}),
        field("chapter_intensity", &L::intensity, "intensity times colour",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = "from `radiance`"})};
}

/// Whose factor light gets that is reflected (C8).
enum class Reflectivity { surface, source };

constexpr auto enum_words(Reflectivity) {
    return std::array{EnumWord{Reflectivity::surface, "surface"},
                      EnumWord{Reflectivity::source, "source"}};
}

/// The surface-by-surface estimator of chapter 2, after T. Whitted, "An improved illumination
/// model for shaded display", 1980.
struct WhittedSettings {
    std::optional<glm::vec3> ambient;    ///< intensity * colour; else the environment's radiance
    std::optional<glm::vec3> background; ///< what a miss sees; else the environment
    bool saturate = true;                ///< sums are cut at 1 at every node
    Reflectivity reflectivity = Reflectivity::surface;
    bool distance_falloff = false; ///< indirect light is divided by the squared distance
    bool fresnel = false;          ///< splits transparent surfaces by Fresnel's formula
    float epsilon = 0.0f;     ///< rays whose product of factors is not above it are not followed
    uint32_t wavelengths = 7; ///< that a white ray splits into at a dispersive surface

    bool operator==(const WhittedSettings&) const = default;
};

constexpr auto fields_of(TypeTag<WhittedSettings>) {
    using W = WhittedSettings;
    return std::tuple{
        field("ambient", &W::ambient, "colour times intensity of the ambient light",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = "the environment's radiance"}),
        field("background", &W::background, "colour of a miss",
              {.range = NOT_NEGATIVE, .form = Form::color, .absent = "the environment"}),
        field("saturate", &W::saturate, "cut every sum at 1"),
        field("reflectivity", &W::reflectivity, "whose factor reflected light gets"),
        field("distance_falloff", &W::distance_falloff,
              "divide indirect light by the squared distance"),
        field("fresnel", &W::fresnel, "split transparent surfaces by Fresnel's formula"),
        field("epsilon", &W::epsilon,
              "rays whose product of factors is not above it are not followed", {.range = UNIT}),
        field("wavelengths", &W::wavelengths, "that a white ray splits into",
              {.range = {.low = 3, .high = 16}})};
}

/// How many lights were given in one measure only, by the one that was derived.
struct DerivedLights {
    uint32_t intensities = 0, measures = 0;
};

/// Intensity times colour (is * Cs) of lights without geometry, by index, in lists of the same
/// names.
struct LightIntensities {
#define ONDE_LIST(Type, list, words) std::map<uint32_t, glm::vec3> list;
    LIGHT_LISTS(ONDE_LIST)
#undef ONDE_LIST
};

/// What a scene file says of the chapter. Lists are by index into the scene's, and hold what files
/// state; see phong.h for what follows from the rest.
struct ChapterScene {
    std::map<uint32_t, Phong> phong; ///< by material
    LightIntensities intensities;    ///< complete_scene() adds what is missing
    std::vector<AreaLight> area_lights;
    DerivedLights derived_lights; ///< filled in by complete_scene()
    WhittedSettings whitted;
    bool states_whitted = false; ///< then [whitted] of included files is left out
    std::optional<Lesson> lesson;
};

} // namespace onde
