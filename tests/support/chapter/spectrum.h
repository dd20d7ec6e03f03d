// The wavelengths that a white ray splits into.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <vector>

namespace onde::chapter {

struct Wavelength {
    double micrometres;
    glm::dvec3 filter; ///< linear RGB; the filters of all wavelengths add up to white
};
std::vector<Wavelength> split_white(uint32_t count);

/// Cauchy's law through the index at 0.5876 micrometres with the Abbe number's slope.
double refractive_index(double index, double abbe, double micrometres);

} // namespace onde::chapter
