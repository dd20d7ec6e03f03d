// Colours and spectra of pbrt's parameters: rgb, blackbody, tables, files and names.
#pragma once

#include "scene/pbrt/parameters.h"
#include "scene/pbrt/sources.h"
#include "scene/spectrum/curve.h"

#include <glm/glm.hpp>

namespace onde::pbrt {

/// A linear sRGB colour, or a spectrum.
struct Spectrum {
    std::optional<glm::dvec3> rgb{};
    spectrum::Function curve{}; ///< where there is no rgb
};

/// The value of a parameter; nothing where it is absent, a texture, or wrong, which is noted.
std::optional<Spectrum> spectrum_of(const Parameters& parameters, std::string_view name,
                                    const Sources& sources);

/// What reflects it, between 0 and 1.
glm::vec3 surface_color(const Spectrum& spectrum);

/// What emits it, not negative. Spectra are taken by their shape alone: their luminance is 1.
glm::vec3 light_color(const Spectrum& spectrum);

/// What a conductor reflects of light that meets it head on, and Material::edge_tint.
struct ConductorColors {
    glm::vec3 normal, edge_tint;
};
ConductorColors conductor_colors(const Spectrum& eta, const Spectrum& k);

/// One index of refraction for all colours.
double yellow_index(const Spectrum& eta);

} // namespace onde::pbrt
