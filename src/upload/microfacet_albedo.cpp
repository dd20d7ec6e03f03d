#include "upload/microfacet_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace onde {
namespace {

/// A sum is kept by this many parts, which compilers make a vector's.
constexpr size_t LANES = 16;

/// Points of half a unit disk, which a symmetric integrand takes for the whole.
template <size_t RINGS, size_t SECTORS>
struct DiskPoints {
    static constexpr size_t COUNT = RINGS * SECTORS;
    std::array<float, COUNT> x, y, weight;

    /// Denser towards the rim, which stands for microfacets of all steep slopes.
    DiskPoints();
};

/// The direction of pi / turns, a power of two, from square roots alone: pictures must not depend
/// on whose library computes sines.
std::complex<double> part_of_half_turn(size_t parts) {
    double cosine = -1;
    for (; parts > 1; parts /= 2) cosine = std::sqrt((1 + cosine) / 2);
    return {cosine, std::sqrt(1 - cosine * cosine)};
}

template <size_t RINGS, size_t SECTORS>
DiskPoints<RINGS, SECTORS>::DiskPoints() {
    const std::complex<double> step = part_of_half_turn(SECTORS);
    std::complex<double> direction = part_of_half_turn(2 * SECTORS) / part_of_half_turn(2);
    double sum = 0;
    for (size_t j = 0; j < SECTORS; j++, direction *= step)
        for (size_t i = 0; i < RINGS; i++) {
            const double left = 1 - (double(i) + 0.5) / RINGS;
            const double radius = std::sqrt(1 - left * left * left);
            x[j * RINGS + i] = float(radius * direction.real());
            y[j * RINGS + i] = float(radius * direction.imag());
            weight[j * RINGS + i] = float(left * left);
            sum += left * left;
        }
    for (float& w : weight) w = float(w / sum);
}

float lambda(float cosine, float alpha) {
    const float tangent2 = (1 - cosine * cosine) / (cosine * cosine);
    return 0.5f * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

/// Masking and shadowing over the masking of the view alone; nothing leaves at or below 0.
float shadowing(float seen, float leaving, float alpha) {
    const float part = (1 + seen) / (1 + seen + lambda(std::max(leaving, 1e-6f), alpha));
    return leaving > 0 ? part : 0;
}

float schlick_weight(float cosine) {
    const float m = 1 - std::clamp(cosine, 0.0f, 1.0f);
    return m * m * (m * m) * m;
}

/// A microfacet that is seen: cosines of its normal with the view direction and the surface's
/// normal.
struct Microfacet {
    float out, up;
};

/// Two means at once.
struct Pair {
    double first, second;
};

/// The means of part(microfacet), a std::array of two numbers, over microfacets that are seen under
/// a cosine, in proportion to how much is seen of each (Heitz 2018).
template <class Points, class Part>
Pair mean_of_microfacets(float cosine, float alpha, const Part& part) {
    static const Points points;
    const float sine = std::sqrt(1 - cosine * cosine);
    const float length = std::sqrt(alpha * alpha * sine * sine + cosine * cosine);
    const float x = alpha * sine / length, z = cosine / length; // the view, stretched
    const float s = 0.5f * (1 + z);
    std::array<float, LANES> first{}, second{};
    for (size_t i = 0; i < Points::COUNT; i += LANES)
        for (size_t k = 0; k < LANES; k++) {
            const float px = points.x[i + k];
            const float across = (1 - s) * std::sqrt(1 - px * px) + s * points.y[i + k];
            const float ahead = std::sqrt(std::max(1 - px * px - across * across, 0.0f));
            const float nx = alpha * (ahead * x - across * z), ny = alpha * px;
            const float nz = std::max(ahead * z + across * x, 1e-6f);
            const float scale = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
            const auto both = part(Microfacet{(nx * sine + nz * cosine) * scale, nz * scale});
            first[k] += points.weight[i + k] * both[0];
            second[k] += points.weight[i + k] * both[1];
        }
    Pair sum{0, 0};
    for (size_t k = 0; k < LANES; k++) {
        sum.first += double(first[k]);
        sum.second += double(second[k]);
    }
    return sum;
}

/// What a boundary scatters of the light that meets a microfacet.
float scattered(Microfacet m, float cosine, float alpha, float seen, float eta) {
    const float out = std::max(m.out, 0.0f), sine2 = (1 - out * out) / (eta * eta);
    const float in = std::sqrt(std::max(1 - sine2, 0.0f));
    const float p = (eta * out - in) / (eta * out + in), s = (out - eta * in) / (out + eta * in);
    const float fresnel = sine2 >= 1 ? 1.0f : 0.5f * (p * p + s * s);
    const float refracted = cosine / eta - (out / eta - in) * m.up;
    return fresnel * shadowing(seen, 2 * out * m.up - cosine, alpha) +
           (1 - fresnel) * shadowing(seen, refracted, alpha);
}

} // namespace

ReflectionAlbedo reflection_albedo(double cosine, double alpha) {
    const auto c = float(cosine), a = float(alpha);
    const float seen = lambda(c, a);
    const Pair mean = mean_of_microfacets<DiskPoints<64, 16>>(c, a, [&](Microfacet m) {
        const float reflected = shadowing(seen, 2 * m.out * m.up - c, a);
        return std::array{reflected, reflected * schlick_weight(m.out)};
    });
    return {mean.first, mean.second};
}

double sheen_albedo(double cosine, double alpha) {
    constexpr int POLAR = 64, AROUND = 32;
    const double sine = std::sqrt(1 - cosine * cosine), inverse = 1 / alpha;
    double sum = 0;
    for (int i = 0; i < POLAR; i++)
        for (int j = 0; j < AROUND; j++) {
            // Evenly by the square of the sine: the cosine is in the weights.
            const double sine2 = (i + 0.5) / POLAR, in = std::sqrt(1 - sine2);
            const double x = std::sqrt(sine2) * std::cos((j + 0.5) / AROUND * M_PI) + sine;
            const double y2 = sine2 - (x - sine) * (x - sine), up = in + cosine;
            const double h2 = up * up / (x * x + y2 + up * up);
            const double d = (2 + inverse) * std::pow(1 - h2, 0.5 * inverse) / (2 * M_PI);
            sum += d * 0.25 / (in + cosine - in * cosine);
        }
    return sum * M_PI / (POLAR * AROUND);
}

GlassAlbedo glass_albedo(double cosine, double alpha, double ior) {
    const auto c = float(cosine), a = float(alpha), outside = float(ior), inside = float(1 / ior);
    const float seen = lambda(c, a);
    const Pair mean = mean_of_microfacets<DiskPoints<64, 32>>(c, a, [&](Microfacet m) {
        return std::array{scattered(m, c, a, seen, outside), scattered(m, c, a, seen, inside)};
    });
    return {mean.first, mean.second};
}

} // namespace onde
