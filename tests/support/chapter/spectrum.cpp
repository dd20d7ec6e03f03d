#include "support/chapter/spectrum.h"

#include <cmath>

namespace onde::chapter {
namespace {

double lobe(double x, double middle, double left, double right) {
    const double z = (x - middle) / (x < middle ? left : right);
    return std::exp(-0.5 * z * z);
}

/// CIE 1931 in the multi-lobe fit of Wyman, Sloan and Shirley (2013), to linear sRGB (IEC
/// 61966-2-1), negative components cut.
glm::dvec3 spectral_colour(double nm) {
    const double x = 1.056 * lobe(nm, 599.8, 37.9, 31.0) + 0.362 * lobe(nm, 442.0, 16.0, 26.7) -
                     0.065 * lobe(nm, 501.1, 20.4, 26.2);
    const double y = 0.821 * lobe(nm, 568.8, 46.9, 40.5) + 0.286 * lobe(nm, 530.9, 16.3, 31.1);
    const double z = 1.217 * lobe(nm, 437.0, 11.8, 36.0) + 0.681 * lobe(nm, 459.0, 26.0, 13.8);
    return glm::max(glm::dvec3(3.2406 * x - 1.5372 * y - 0.4986 * z,
                               -0.9689 * x + 1.8758 * y + 0.0415 * z,
                               0.0557 * x - 0.2040 * y + 1.0570 * z),
                    0.0);
}

} // namespace

std::vector<Wavelength> split_white(uint32_t count) {
    std::vector<Wavelength> result(count);
    glm::dvec3 sum(0);
    for (uint32_t j = 0; j < count; ++j) {
        result[j].micrometres = 0.42 + 0.26 * (j + 0.5) / count;
        result[j].filter = spectral_colour(1000 * result[j].micrometres);
        sum += result[j].filter;
    }
    for (Wavelength& wavelength : result) wavelength.filter /= sum;
    return result;
}

double refractive_index(double index, double abbe, double micrometres) {
    const double b = (index - 1) / (abbe * (1 / (0.4861 * 0.4861) - 1 / (0.6563 * 0.6563)));
    const double a = index - b / (0.5876 * 0.5876);
    return a + b / (micrometres * micrometres);
}

} // namespace onde::chapter
