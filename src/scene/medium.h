// What absorbs and scatters light on its way: fog, smoke, milk, coloured glass.
#pragma once

#include "scene/fields.h"

#include <glm/glm.hpp>

namespace onde {

/// The same everywhere in it. Light that meets it is absorbed and scattered at these rates per unit
/// of length; scattering goes by Henyey and Greenstein's phase function.
struct Medium {
    glm::vec3 absorption{0.0f};
    glm::vec3 scattering{0.0f};
    float anisotropy = 0.0f; ///< the mean cosine: 0 to all sides, towards 1 straight on

    bool operator==(const Medium&) const = default;
};

constexpr auto fields_of(TypeTag<Medium>) {
    return std::tuple{field("absorption", &Medium::absorption,
                            "of light that meets it, per unit of length",
                            {.range = NOT_NEGATIVE, .form = Form::color}),
                      field("scattering", &Medium::scattering, "the same of what goes on elsewhere",
                            {.range = NOT_NEGATIVE, .form = Form::color}),
                      field("anisotropy", &Medium::anisotropy,
                            "mean cosine of Henyey and Greenstein's phase function",
                            {.range = {.low = -0.99, .high = 0.99}})};
}

} // namespace onde
