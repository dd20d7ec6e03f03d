// What absorbs and scatters light on its way: fog, smoke, milk, coloured glass; and what glows on
// its own: flames.
#pragma once

#include "scene/fields.h"
#include "scene/grid.h"

#include <glm/glm.hpp>

namespace onde {

/// The same everywhere in it, or as dense as a grid says. Light that meets it is absorbed and
/// scattered at these rates per unit of length, at density 1; scattering goes by Henyey and
/// Greenstein's phase function.
struct Medium {
    glm::vec3 absorption{0.0f};
    glm::vec3 scattering{0.0f};
    glm::vec3 emission{0.0f}; ///< of radiance, per unit of length
    float anisotropy = 0.0f;  ///< the mean cosine: 0 to all sides, towards 1 straight on
    float density_scale = 1.0f;
    uint32_t grid = NO_GRID;   ///< of the scene
    glm::mat4 placement{1.0f}; ///< from the grid's own space to the world

    bool operator==(const Medium&) const = default;
};

constexpr auto fields_of(TypeTag<Medium>) {
    return std::tuple{
        field("absorption", &Medium::absorption, "of light that meets it, per unit of length",
              {.range = NOT_NEGATIVE, .form = Form::color}),
        field("scattering", &Medium::scattering, "the same of what goes on elsewhere",
              {.range = NOT_NEGATIVE, .form = Form::color}),
        field("emission", &Medium::emission, "radiance that it adds, per unit of length",
              {.range = NOT_NEGATIVE, .form = Form::color}),
        field("anisotropy", &Medium::anisotropy,
              "mean cosine of Henyey and Greenstein's phase function",
              {.range = {.low = -0.99, .high = 0.99}}),
        LoaderKey{"density", "`.nvdb` (NanoVDB) or `.vol` (Mitsuba) file",
                  "a grid whose densities these rates are multiplied by", "the same everywhere"},
        field("density_scale", &Medium::density_scale, "of the grid's densities",
              {.range = NOT_NEGATIVE}),
        LoaderKey{"position", "`[x, y, z]`", "of the grid, in the world", "`[0, 0, 0]`"},
        LoaderKey{"rotation", "`[x, y, z]` in degrees", "about X, then Y, then Z", "`[0, 0, 0]`"},
        LoaderKey{"scale", "`[x, y, z]` or one number", "none of them 0", "`1`"},
        field_without_key(&Medium::grid, "grid of densities", {.form = Form::grid}),
        field_without_key(&Medium::placement, "placement of the grid")};
}

/// Where the grid is instead, of a medium that has one.
inline Medium placed(Medium medium, const glm::mat4& transform) {
    if (medium.grid != NO_GRID) medium.placement = transform * medium.placement;
    return medium;
}

} // namespace onde
