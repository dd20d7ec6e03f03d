// Optical constants of metals. Ag, Au, Cu: Johnson and Christy, "Optical constants of the noble
// metals", 1972; Cr: the same, "Optical constants of transition metals", 1974; Al: McPeak et al.,
// "Plasmonic films can easily be better", 2015, at the others' wavelengths. All by way of the
// refractiveindex.info database, which is in the public domain.
#include "scene/spectrum/curve.h"

#include <array>

namespace onde::spectrum {
namespace {

constexpr size_t COUNT = 14;
using Row = std::array<double, COUNT>;

constexpr Row WAVELENGTHS{381.5, 397.4, 413.3, 430.5, 450.9, 471.4, 495.9,
                          520.9, 548.6, 582.1, 616.8, 659.5, 704.5, 756.0};

struct Conductor {
    std::string_view symbol;
    Row eta, k;
};

constexpr Conductor CONDUCTORS[] = {
    {"Ag",
     {0.05, 0.05, 0.05, 0.04, 0.04, 0.05, 0.05, 0.05, 0.06, 0.05, 0.06, 0.05, 0.04, 0.03},
     {1.864, 2.07, 2.275, 2.462, 2.657, 2.869, 3.093, 3.324, 3.586, 3.858, 4.152, 4.483, 4.838,
      5.242}},
    {"Al",
     {0.3386, 0.3699, 0.4033, 0.4422, 0.4914, 0.5441, 0.6133, 0.6912, 0.7845, 0.9169, 1.0711,
      1.3015, 1.5926, 2.0151},
     {4.018, 4.197, 4.373, 4.565, 4.788, 5.013, 5.276, 5.546, 5.837, 6.187, 6.535, 6.939, 7.308,
      7.588}},
    {"Au",
     {1.46, 1.47, 1.46, 1.45, 1.38, 1.31, 1.04, 0.62, 0.43, 0.29, 0.21, 0.14, 0.13, 0.14},
     {1.933, 1.952, 1.958, 1.948, 1.914, 1.849, 1.833, 2.081, 2.455, 2.863, 3.272, 3.697, 4.103,
      4.542}},
    {"Cr",
     {1.92, 2.0, 2.08, 2.19, 2.33, 2.51, 2.75, 2.94, 3.18, 3.22, 3.17, 3.09, 3.05, 3.08},
     {2.74, 2.83, 2.93, 3.04, 3.14, 3.24, 3.3, 3.33, 3.33, 3.3, 3.3, 3.34, 3.39, 3.42}},
    {"Cu",
     {1.33, 1.32, 1.28, 1.25, 1.24, 1.25, 1.22, 1.18, 1.02, 0.7, 0.3, 0.22, 0.21, 0.24},
     {2.045, 2.116, 2.207, 2.305, 2.397, 2.483, 2.564, 2.608, 2.577, 2.704, 3.205, 3.747, 4.205,
      4.665}}};

Curve curve(const Row& values) {
    return Curve({WAVELENGTHS.begin(), WAVELENGTHS.end()}, {values.begin(), values.end()}, true);
}

} // namespace

std::optional<Index> conductor_index(std::string_view symbol) {
    for (const Conductor& conductor : CONDUCTORS)
        if (conductor.symbol == symbol) return Index{curve(conductor.eta), curve(conductor.k)};
    return std::nullopt;
}

} // namespace onde::spectrum
