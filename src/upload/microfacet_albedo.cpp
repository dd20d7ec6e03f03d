#include "upload/microfacet_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>

namespace onde {
namespace {

constexpr size_t RINGS = 32, SECTORS = 16;

/// A point of half a unit disk, which a symmetric integrand takes for the whole.
struct DiskPoint {
    double x, y, weight;
};
using DiskPoints = std::array<DiskPoint, RINGS * SECTORS>;

/// The cosine and sine of pi / 2^halvings, from square roots alone: pictures must not depend on
/// whose library computes sines.
std::complex<double> halved_turn(int halvings) {
    double cosine = -1;
    for (int i = 0; i < halvings; i++) cosine = std::sqrt((1 + cosine) / 2);
    return {cosine, std::sqrt(1 - cosine * cosine)};
}

/// Denser towards the rim, which stands for microfacets of all steep slopes.
DiskPoints disk_points() {
    static_assert(SECTORS == 1 << 4);
    DiskPoints points;
    std::complex<double> direction = halved_turn(5) * std::complex<double>(0, -1);
    for (size_t j = 0; j < SECTORS; j++, direction *= halved_turn(4))
        for (size_t i = 0; i < RINGS; i++) {
            const double left = 1 - (double(i) + 0.5) / RINGS;
            const double radius = std::sqrt(1 - left * left * left);
            points[i * SECTORS + j] = {radius * direction.real(), radius * direction.imag(),
                                       left * left};
        }
    double sum = 0;
    for (const DiskPoint& p : points) sum += p.weight;
    for (DiskPoint& p : points) p.weight /= sum;
    return points;
}

double lambda(double cosine, double alpha) {
    const double tangent2 = (1 - cosine * cosine) / (cosine * cosine);
    return 0.5 * (std::sqrt(1 + alpha * alpha * tangent2) - 1);
}

/// A microfacet that is seen: cosines of its normal with the view direction and the surface's
/// normal.
struct Microfacet {
    double out, up;
};

/// Calls visit(microfacet, weight) for microfacets that are seen under a cosine, in proportion to
/// how much is seen of each (Heitz 2018).
template <class Visit>
void for_microfacets(double cosine, double alpha, const Visit& visit) {
    static const DiskPoints points = disk_points();
    const double sine = std::sqrt(1 - cosine * cosine);
    const double length = std::sqrt(alpha * alpha * sine * sine + cosine * cosine);
    const double x = alpha * sine / length, z = cosine / length; // the view, stretched
    const double s = 0.5 * (1 + z);
    for (const DiskPoint& p : points) {
        const double across = (1 - s) * std::sqrt(1 - p.x * p.x) + s * p.y;
        const double ahead = std::sqrt(std::max(1 - p.x * p.x - across * across, 0.0));
        const double nx = alpha * (ahead * x - across * z), ny = alpha * p.x;
        const double nz = std::max(ahead * z + across * x, 1e-6);
        const double scale = 1 / std::sqrt(nx * nx + ny * ny + nz * nz);
        visit(Microfacet{(nx * sine + nz * cosine) * scale, nz * scale}, p.weight);
    }
}

/// Masking and shadowing over the masking of the view alone; nothing leaves at or below 0.
double shadowing(double seen, double leaving, double alpha) {
    return leaving > 0 ? (1 + seen) / (1 + seen + lambda(leaving, alpha)) : 0;
}

double schlick_weight(double cosine) {
    const double m = 1 - std::clamp(cosine, 0.0, 1.0);
    return m * m * (m * m) * m;
}

} // namespace

ReflectionAlbedo reflection_albedo(double cosine, double alpha) {
    ReflectionAlbedo sum{0, 0};
    const double seen = lambda(cosine, alpha);
    for_microfacets(cosine, alpha, [&](Microfacet m, double weight) {
        const double part = weight * shadowing(seen, 2 * m.out * m.up - cosine, alpha);
        sum.white += part;
        sum.grazing += part * schlick_weight(m.out);
    });
    return sum;
}

double glass_albedo(double cosine, double alpha, double eta) {
    double sum = 0;
    const double seen = lambda(cosine, alpha);
    for_microfacets(cosine, alpha, [&](Microfacet m, double weight) {
        const double out = std::max(m.out, 0.0), sine2 = (1 - out * out) / (eta * eta);
        const double in = std::sqrt(std::max(1 - sine2, 0.0));
        const double p = (eta * out - in) / (eta * out + in);
        const double s = (out - eta * in) / (out + eta * in);
        const double fresnel = sine2 >= 1 ? 1 : 0.5 * (p * p + s * s);
        const double refracted = cosine / eta - (out / eta - in) * m.up;
        sum += weight * (fresnel * shadowing(seen, 2 * out * m.up - cosine, alpha) +
                         (1 - fresnel) * shadowing(seen, refracted, alpha));
    });
    return sum;
}

} // namespace onde
