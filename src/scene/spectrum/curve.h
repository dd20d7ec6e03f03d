// Spectra as files state them: tables of wavelengths, glowing bodies, the measured ones that have
// names.
#pragma once

#include "scene/spectrum/cie.h"

#include <optional>
#include <string_view>
#include <vector>

namespace onde::spectrum {

/// A value a wavelength, linear between those that a table states.
class Curve {
  public:
    Curve() = default;
    /// `wavelengths`, in nanometres, rise; there are as many values.
    Curve(std::vector<double> wavelengths, std::vector<double> values, bool goes_on = false);

    /// Beyond the table 0, or its last value where it goes on.
    double operator()(double wavelength) const;

  private:
    std::vector<double> wavelengths_, values_;
    bool goes_on_ = false;
};

/// Of pairs of a wavelength and a value, as both formats write them; nothing unless the wavelengths
/// rise and all numbers are finite.
std::optional<Curve> curve_of_pairs(const std::vector<double>& numbers);

/// What a black body of that temperature, in kelvin, emits, as a function whose largest value in
/// the visible range is about 1 (Planck's law).
Function black_body(double kelvin);

/// A substance's index of refraction; conductors have an extinction coefficient too.
struct Index {
    Curve eta, k;
};

/// Of a conductor by its chemical symbol: "Ag", "Al", "Au", "Cr", "Cu".
std::optional<Index> conductor_index(std::string_view symbol);

} // namespace onde::spectrum
