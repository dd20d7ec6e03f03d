#include "upload/microfacet_albedo.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>

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

float beckmann_lambda(float cosine, float alpha) {
    const float a = cosine / (alpha * std::sqrt(std::max(1 - cosine * cosine, 1e-12f)));
    const float root = std::sqrt(std::numbers::pi_v<float>);
    return std::max(0.5f * (std::exp(-a * a) / (a * root) - std::erfc(a)), 0.0f);
}

/// Masking and shadowing over the masking of the view alone; nothing leaves at or below 0.
using Lambda = float (*)(float, float);
template <Lambda lambda>
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

/// The same of Beckmann's microfacets, whose slopes are Gaussian: evenly over the distribution's
/// radii, weighted by how much is seen.
template <class Part>
Pair mean_of_beckmann(float cosine, float alpha, const Part& part) {
    constexpr int RINGS = 64, SECTORS = 32;
    const double sine = std::sqrt(1 - double(cosine) * double(cosine));
    Pair sum{0, 0};
    double weights = 0;
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SECTORS; j++) {
            const double radius = double(alpha) * std::sqrt(-std::log((i + 0.5) / RINGS));
            const double slope = radius * std::cos((j + 0.5) / SECTORS * std::numbers::pi);
            const double weight = double(cosine) + slope * sine;
            if (weight <= 0) continue;
            const double up = 1 / std::sqrt(1 + radius * radius);
            const auto both = part(Microfacet{float(weight * up), float(up)});
            sum.first += weight * double(both[0]);
            sum.second += weight * double(both[1]);
            weights += weight;
        }
    return {sum.first / weights, sum.second / weights};
}

/// The mean of either distribution's microfacets, of part.operator()<lambda>(lambda of the view,
/// microfacet). Points: those that GGX's are counted at.
template <class Points, class Part>
Pair mean_of(Distribution distribution, float cosine, float alpha, const Part& part) {
    if (distribution == Distribution::beckmann)
        return mean_of_beckmann(cosine, alpha,
                                [&, seen = beckmann_lambda(cosine, alpha)](Microfacet m) {
                                    return part.template operator()<beckmann_lambda>(seen, m);
                                });
    return mean_of_microfacets<Points>(cosine, alpha,
                                       [&, seen = lambda(cosine, alpha)](Microfacet m) {
                                           return part.template operator()<lambda>(seen, m);
                                       });
}

/// Smith's Lambda by the length of a direction's part along the surface, stretched by alphas.
float stretched_lambda(float cosine, float flat) {
    const float slope = flat / cosine;
    return 0.5f * (std::sqrt(1 + slope * slope) - 1);
}

/// What a boundary scatters of the light that meets a microfacet.
template <Lambda lambda>
float scattered(Microfacet m, float cosine, float alpha, float seen, float eta) {
    const float out = std::max(m.out, 0.0f), sine2 = (1 - out * out) / (eta * eta);
    const float in = std::sqrt(std::max(1 - sine2, 0.0f));
    const float p = (eta * out - in) / (eta * out + in), s = (out - eta * in) / (out + eta * in);
    const float fresnel = sine2 >= 1 ? 1.0f : 0.5f * (p * p + s * s);
    const float refracted = cosine / eta - (out / eta - in) * m.up;
    return fresnel * shadowing<lambda>(seen, 2 * out * m.up - cosine, alpha) +
           (1 - fresnel) * shadowing<lambda>(seen, refracted, alpha);
}

} // namespace

ReflectionAlbedo reflection_albedo(double cosine, double alpha, Distribution distribution) {
    const auto c = float(cosine), a = float(alpha);
    const auto part = [&]<Lambda lambda>(float seen, Microfacet m) {
        const float reflected = shadowing<lambda>(seen, 2 * m.out * m.up - c, a);
        return std::array{reflected, reflected * schlick_weight(m.out)};
    };
    const Pair mean = mean_of<DiskPoints<64, 16>>(distribution, c, a, part);
    return {mean.first, mean.second};
}

ReflectionAlbedo grain_albedo(double cosine, double along, double alpha_x, double alpha_y) {
    using Points = DiskPoints<32, 16>;
    static const Points points;
    const double sine = std::sqrt(1 - cosine * cosine), across = std::sqrt(1 - along * along);
    const auto c = float(cosine), ax = float(alpha_x), ay = float(alpha_y);
    const auto ox = float(sine * along), oy = float(sine * across);
    const float px = ax * ox, py = ay * oy, flat = std::sqrt(px * px + py * py);
    const float length = std::sqrt(flat * flat + c * c);
    const float vx = px / length, vy = py / length, vz = c / length; // the view, stretched
    const float tx = flat > 0 ? -py / flat : 1, ty = flat > 0 ? px / flat : 0;
    const float s = 0.5f * (1 + vz), seen = stretched_lambda(c, flat);
    std::array<float, LANES> white{}, grazing{};
    for (size_t i = 0; i < 2 * Points::COUNT; i += LANES)
        for (size_t k = 0; k < LANES; k++) {
            const size_t at = (i + k) % Points::COUNT; // the other half of the disk
            const float p = i < Points::COUNT ? points.x[at] : -points.x[at];
            const float q = (1 - s) * std::sqrt(1 - p * p) + s * points.y[at];
            const float ahead = std::sqrt(std::max(1 - p * p - q * q, 0.0f));
            // Along the view, and across it both ways; the second of those is view x first.
            const float nx = ax * (ahead * vx + p * tx - q * vz * ty);
            const float ny = ay * (ahead * vy + p * ty + q * vz * tx);
            const float nz = std::max(ahead * vz + q * (vx * ty - vy * tx), 1e-6f);
            const float scale = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
            const float out = (nx * ox + ny * oy + nz * c) * scale;
            const float wx = 2 * out * nx * scale - ox, wy = 2 * out * ny * scale - oy;
            const float wz = 2 * out * nz * scale - c;
            const float bent = std::sqrt(ax * ax * wx * wx + ay * ay * wy * wy);
            const float part =
                (1 + seen) / (1 + seen + stretched_lambda(std::max(wz, 1e-6f), bent));
            const float reflected = wz > 0 ? 0.5f * points.weight[at] * part : 0;
            white[k] += reflected;
            grazing[k] += reflected * schlick_weight(out);
        }
    ReflectionAlbedo sum{0, 0};
    for (size_t k = 0; k < LANES; k++) {
        sum.white += double(white[k]);
        sum.grazing += double(grazing[k]);
    }
    return sum;
}

ReflectionAlbedo beckmann_grain_albedo(double cosine, double along, double alpha_x,
                                       double alpha_y) {
    constexpr int RINGS = 24, SECTORS = 48;
    const double sine = std::sqrt(1 - cosine * cosine), across = std::sqrt(1 - along * along);
    const glm::dvec3 out(sine * along, sine * across, cosine);
    const auto smith = [&](glm::dvec3 w) {
        const double a = w.z / std::max(std::hypot(alpha_x * w.x, alpha_y * w.y), 1e-9);
        return std::max(
            std::exp(-a * a) / (2 * a * std::sqrt(std::numbers::pi)) - 0.5 * std::erfc(a), 0.0);
    };
    const double seen = smith(out);
    ReflectionAlbedo sum{0, 0};
    double weights = 0;
    for (int i = 0; i < RINGS; i++)
        for (int j = 0; j < SECTORS; j++) {
            const double radius = std::sqrt(-std::log((i + 0.5) / RINGS));
            const double turn = (j + 0.5) / SECTORS * 2 * std::numbers::pi;
            const glm::dvec3 facet(alpha_x * radius * std::cos(turn),
                                   alpha_y * radius * std::sin(turn), 1);
            const double weight = glm::dot(out, facet);
            if (weight <= 0) continue;
            weights += weight;
            const glm::dvec3 h = glm::normalize(facet);
            const glm::dvec3 in = 2 * glm::dot(out, h) * h - out;
            if (in.z <= 0) continue;
            const double kept = weight * (1 + seen) / (1 + seen + smith(in));
            sum.white += kept;
            sum.grazing += kept * double(schlick_weight(float(glm::dot(out, h))));
        }
    return {sum.white / weights, sum.grazing / weights};
}

double sheen_albedo(double cosine, double alpha) {
    constexpr int POLAR = 64, AROUND = 32;
    const double sine = std::sqrt(1 - cosine * cosine), inverse = 1 / alpha;
    double sum = 0;
    for (int i = 0; i < POLAR; i++)
        for (int j = 0; j < AROUND; j++) {
            // Evenly by the root of the cosine: fibres shine at grazing angles.
            const double root = (i + 0.5) / POLAR, in = root * root, sine2 = 1 - in * in;
            const double x = std::sqrt(sine2) * std::cos((j + 0.5) / AROUND * M_PI) + sine;
            const double y2 = sine2 - (x - sine) * (x - sine), up = in + cosine;
            const double h2 = up * up / (x * x + y2 + up * up);
            const double d = (2 + inverse) * std::pow(1 - h2, 0.5 * inverse) / (2 * M_PI);
            sum += 4 * root * in * d * 0.25 / (in + cosine - in * cosine);
        }
    return sum * M_PI / (POLAR * AROUND);
}

GlassAlbedo glass_albedo(double cosine, double alpha, double ior, Distribution distribution) {
    const auto c = float(cosine), a = float(alpha), outside = float(ior), inside = float(1 / ior);
    const auto part = [&]<Lambda lambda>(float seen, Microfacet m) {
        return std::array{scattered<lambda>(m, c, a, seen, outside),
                          scattered<lambda>(m, c, a, seen, inside)};
    };
    const Pair mean = mean_of<DiskPoints<64, 32>>(distribution, c, a, part);
    return {mean.first, mean.second};
}

} // namespace onde
