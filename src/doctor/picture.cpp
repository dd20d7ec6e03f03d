// Parity with the built-in picture, which PoCL on a CPU has made.
#include "doctor/built_in_picture.h"
#include "doctor/built_in_scene.h"
#include "doctor/checks.h"
#include "doctor/pictures.h"

#include <algorithm>
#include <cmath>

namespace onde::doctor {

namespace {

/// Floats in the order of their values.
int64_t place_of(float a) {
    const auto bits = int64_t(std::bit_cast<uint32_t>(a));
    return bits < 0x80000000 ? bits : 0x80000000 - bits;
}

constexpr int64_t MOST_UNITS = 256; ///< in the last place, of a number that rounding moved
constexpr double MOST_MOVED = 0.02; ///< share of numbers whose paths may have gone another way
constexpr double MOST_OF_MEAN = 1e-3;

} // namespace

Finding check_picture(const CheckContext& context) {
    const Image image = picture_of(context, built_in_scene(), built_in_options(context));
    size_t differ = 0, moved = 0;
    int64_t most = 0;
    double mean = 0, wanted_mean = 0;
    for (size_t i = 0; i < image.pixels.size(); ++i) {
        const float wanted = std::bit_cast<float>(BUILT_IN_PICTURE[i]);
        const int64_t units = std::abs(place_of(image.pixels[i]) - place_of(wanted));
        differ += units != 0;
        moved += !(units <= MOST_UNITS);
        most = std::max(most, units);
        mean += image.pixels[i];
        wanted_mean += wanted;
    }
    const auto count = double(image.pixels.size());
    Finding finding{.value = double(differ), .unit = fmt::format("of {} numbers differ", count)};
    finding.passed =
        double(moved) <= MOST_MOVED * count && std::abs(mean / wanted_mean - 1) <= MOST_OF_MEAN;
    if (differ)
        finding.text = fmt::format("by up to {} units in the last place, {} by more than {}; the "
                                   "mean is {:.6g} instead of {:.6g}",
                                   most, moved, MOST_UNITS, mean / count, wanted_mean / count);
    return finding;
}

} // namespace onde::doctor
