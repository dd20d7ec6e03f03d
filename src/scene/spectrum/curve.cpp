#include "scene/spectrum/curve.h"

#include <algorithm>
#include <cmath>

namespace onde::spectrum {

Curve::Curve(std::vector<double> wavelengths, std::vector<double> values, bool goes_on)
    : wavelengths_(std::move(wavelengths)), values_(std::move(values)), goes_on_(goes_on) {}

double Curve::operator()(double wavelength) const {
    if (wavelengths_.empty()) return 0.0;
    const bool inside = wavelength >= wavelengths_.front() && wavelength <= wavelengths_.back();
    if (!inside && !goes_on_) return 0.0;
    const auto above = std::ranges::upper_bound(wavelengths_, wavelength);
    if (above == wavelengths_.begin()) return values_.front();
    if (above == wavelengths_.end()) return values_.back();
    const auto i = size_t(above - wavelengths_.begin());
    const double share =
        (wavelength - wavelengths_[i - 1]) / (wavelengths_[i] - wavelengths_[i - 1]);
    return values_[i - 1] + share * (values_[i] - values_[i - 1]);
}

std::optional<Curve> curve_of_pairs(const std::vector<double>& numbers) {
    if (numbers.empty() || numbers.size() % 2 != 0) return std::nullopt;
    std::vector<double> wavelengths, values;
    for (size_t i = 0; i < numbers.size(); i += 2) {
        if (!std::isfinite(numbers[i]) || !std::isfinite(numbers[i + 1])) return std::nullopt;
        if (!wavelengths.empty() && numbers[i] <= wavelengths.back()) return std::nullopt;
        wavelengths.push_back(numbers[i]);
        values.push_back(numbers[i + 1]);
    }
    return Curve(std::move(wavelengths), std::move(values));
}

Function black_body(double kelvin) {
    constexpr double SECOND_RADIATION = 1.438776877e7; // nm K
    constexpr double GREEN = 555.0;
    const auto planck = [kelvin](double wavelength) {
        return std::pow(GREEN / wavelength, 5.0) /
               std::expm1(std::min(SECOND_RADIATION / (wavelength * kelvin), 600.0));
    };
    const double most = std::max({planck(360.0), planck(GREEN), planck(780.0)});
    return [planck, most](double wavelength) { return planck(wavelength) / most; };
}

} // namespace onde::spectrum
