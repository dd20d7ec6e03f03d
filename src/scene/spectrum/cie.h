// How the eye sees a spectrum, as linear sRGB. It knows nothing of files.
#pragma once

#include <glm/glm.hpp>

#include <functional>

namespace onde::spectrum {

/// A function of the wavelength in nanometres.
using Function = std::function<double(double)>;

/// The colour of light of that spectrum; a constant 1 has the luminance 1 (CIE 1931, 2 degrees).
/// Colours that sRGB does not have are negative somewhere.
glm::dvec3 color_of_light(const Function& radiance);

/// The same of light of one wavelength, per nanometre.
glm::dvec3 color_of_wavelength(double wavelength);

/// The colour of a surface that reflects that share of D65; a constant 1 is white.
glm::dvec3 color_of_surface(const Function& reflectance);

/// The linear sRGB colour of CIE XYZ (IEC 61966-2-1).
glm::dvec3 srgb_of_xyz(const glm::dvec3& xyz);

/// Nanometres: what color_of_light() has divided by, so that a spectrum of W/nm times it is in W of
/// the same luminance, at the wavelength that is seen best.
double integral_of_observer();

/// The luminance of a linear sRGB colour.
double luminance(const glm::dvec3& color);

/// Relative power of the CIE's standard daylight of 6504 K; 0 beyond 380 to 780 nm.
double d65(double wavelength);

} // namespace onde::spectrum
