#include "scene/spectrum/cie.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace onde::spectrum {
namespace {

constexpr double FIRST = 360.0, LAST = 780.0;

/// Colour matching functions of the CIE 1931 standard observer, every 5 nm from FIRST to LAST.
constexpr glm::dvec3 OBSERVER[] = {{0.0001299, 3.9e-06, 0.0006061},
                                   {0.0002321, 7e-06, 0.001086},
                                   {0.0004149, 1.24e-05, 0.001946},
                                   {0.0007416, 2.2e-05, 0.003486},
                                   {0.001368, 3.9e-05, 0.00645},
                                   {0.002236, 6.4e-05, 0.01055},
                                   {0.004243, 0.00012, 0.02005},
                                   {0.00765, 0.000217, 0.03621},
                                   {0.01431, 0.000396, 0.06785},
                                   {0.02319, 0.00064, 0.1102},
                                   {0.04351, 0.00121, 0.2074},
                                   {0.07763, 0.00218, 0.3713},
                                   {0.13438, 0.004, 0.6456},
                                   {0.21477, 0.0073, 1.03905},
                                   {0.2839, 0.0116, 1.3856},
                                   {0.3285, 0.01684, 1.62296},
                                   {0.34828, 0.023, 1.74706},
                                   {0.34806, 0.0298, 1.7826},
                                   {0.3362, 0.038, 1.77211},
                                   {0.3187, 0.048, 1.7441},
                                   {0.2908, 0.06, 1.6692},
                                   {0.2511, 0.0739, 1.5281},
                                   {0.19536, 0.09098, 1.28764},
                                   {0.1421, 0.1126, 1.0419},
                                   {0.09564, 0.13902, 0.81295},
                                   {0.05795, 0.1693, 0.6162},
                                   {0.03201, 0.20802, 0.46518},
                                   {0.0147, 0.2586, 0.3533},
                                   {0.0049, 0.323, 0.272},
                                   {0.0024, 0.4073, 0.2123},
                                   {0.0093, 0.503, 0.1582},
                                   {0.0291, 0.6082, 0.1117},
                                   {0.06327, 0.71, 0.07825},
                                   {0.1096, 0.7932, 0.05725},
                                   {0.1655, 0.862, 0.04216},
                                   {0.22575, 0.91485, 0.02984},
                                   {0.2904, 0.954, 0.0203},
                                   {0.3597, 0.9803, 0.0134},
                                   {0.43345, 0.99495, 0.00875},
                                   {0.51205, 1, 0.00575},
                                   {0.5945, 0.995, 0.0039},
                                   {0.6784, 0.9786, 0.00275},
                                   {0.7621, 0.952, 0.0021},
                                   {0.8425, 0.9154, 0.0018},
                                   {0.9163, 0.87, 0.00165},
                                   {0.9786, 0.8163, 0.0014},
                                   {1.0263, 0.757, 0.0011},
                                   {1.0567, 0.6949, 0.001},
                                   {1.0622, 0.631, 0.0008},
                                   {1.0456, 0.5668, 0.0006},
                                   {1.0026, 0.503, 0.00034},
                                   {0.9384, 0.4412, 0.00024},
                                   {0.85445, 0.381, 0.00019},
                                   {0.7514, 0.321, 0.0001},
                                   {0.6424, 0.265, 5e-05},
                                   {0.5419, 0.217, 3e-05},
                                   {0.4479, 0.175, 2e-05},
                                   {0.3608, 0.1382, 1e-05},
                                   {0.2835, 0.107, 0},
                                   {0.2187, 0.0816, 0},
                                   {0.1649, 0.061, 0},
                                   {0.1212, 0.04458, 0},
                                   {0.0874, 0.032, 0},
                                   {0.0636, 0.0232, 0},
                                   {0.04677, 0.017, 0},
                                   {0.0329, 0.01192, 0},
                                   {0.0227, 0.00821, 0},
                                   {0.01584, 0.005723, 0},
                                   {0.011359, 0.004102, 0},
                                   {0.008111, 0.002929, 0},
                                   {0.00579, 0.002091, 0},
                                   {0.004109, 0.001484, 0},
                                   {0.002899, 0.001047, 0},
                                   {0.002049, 0.00074, 0},
                                   {0.00144, 0.00052, 0},
                                   {0.001, 0.000361, 0},
                                   {0.00069, 0.000249, 0},
                                   {0.000476, 0.000172, 0},
                                   {0.000332, 0.00012, 0},
                                   {0.000235, 8.5e-05, 0},
                                   {0.000166, 6e-05, 0},
                                   {0.000117, 4.2e-05, 0},
                                   {8.3e-05, 3e-05, 0},
                                   {5.9e-05, 2.1e-05, 0},
                                   {4.2e-05, 1.5e-05, 0}};

/// Standard illuminant D65 every 10 nm from 380 to 780 (ISO/CIE 11664-2).
constexpr double D65[] = {49.9755, 54.6482, 82.7549, 91.486,  93.4318, 86.6823, 104.865,
                          117.008, 117.812, 114.861, 115.923, 108.811, 109.354, 107.802,
                          104.79,  107.689, 104.405, 104.046, 100.0,   96.3342, 95.788,
                          88.6856, 90.0062, 89.5991, 87.6987, 83.2886, 83.6992, 80.0268,
                          80.2146, 82.2778, 78.2842, 69.7213, 71.6091, 74.349,  61.604,
                          69.8856, 75.087,  63.5927, 46.4182, 66.8054, 63.3828};

/// A table's value between its entries; 0 beyond them.
template <class T, size_t N>
T between(const T (&table)[N], double first, double step, double wavelength) {
    const double at = (wavelength - first) / step;
    if (!(at >= 0.0 && at <= double(N - 1))) return T(0.0);
    const size_t i = std::min(size_t(at), N - 2);
    return table[i] + (table[i + 1] - table[i]) * (at - double(i));
}

/// Integrates in steps of 1 nm.
template <class Value>
auto integral(const Value& value) {
    auto sum = value(FIRST) * 0.0;
    for (double wavelength = FIRST; wavelength <= LAST; wavelength += 1.0) sum += value(wavelength);
    return sum;
}

glm::dvec3 observer(double wavelength) {
    return between(OBSERVER, FIRST, 5.0, wavelength);
}

} // namespace

glm::dvec3 srgb_of_xyz(const glm::dvec3& c) {
    return {3.2404542 * c.x - 1.5371385 * c.y - 0.4985314 * c.z,
            -0.969266 * c.x + 1.8760108 * c.y + 0.041556 * c.z,
            0.0556434 * c.x - 0.2040259 * c.y + 1.0572252 * c.z};
}

double d65(double wavelength) {
    return between(D65, 380.0, 10.0, wavelength);
}

double integral_of_observer() {
    static const double all = integral([](double w) { return observer(w).y; });
    return all;
}

double luminance(const glm::dvec3& color) {
    return 0.2126729 * color.x + 0.7151522 * color.y + 0.072175 * color.z;
}

glm::dvec3 color_of_wavelength(double wavelength) {
    return srgb_of_xyz(observer(wavelength)) / integral_of_observer();
}

glm::dvec3 color_of_light(const Function& radiance) {
    return integral([&](double w) { return color_of_wavelength(w) * radiance(w); });
}

glm::dvec3 color_of_surface(const Function& reflectance) {
    static const glm::dvec3 white = color_of_light(d65);
    return color_of_light([&](double w) { return d65(w) * reflectance(w); }) / white;
}

} // namespace onde::spectrum
