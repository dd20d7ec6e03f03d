#include "scene/daylight.h"

#include "scene/load.h"
#include "scene/spectrum/curve.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace onde {
namespace {

constexpr double PI = std::numbers::pi;
constexpr uint32_t MAP_WIDTH = 512;

/// Up to where the sky is like itself, as a cosine: at the horizon the model ends.
constexpr double LEAST_COSINE = 1e-3;

glm::dvec3 direction_of(double elevation, double azimuth) {
    return {std::cos(elevation) * std::sin(azimuth), std::sin(elevation),
            -std::cos(elevation) * std::cos(azimuth)};
}

/// The air between the eye and the sun, over that at the zenith (Preetham et al., appendix A.1).
double air_mass(double zenith_angle) {
    const double degrees = glm::degrees(zenith_angle);
    return 1.0 / (std::cos(zenith_angle) + 0.15 * std::pow(93.885 - degrees, -1.253));
}

/// What ozone absorbs, per centimetre (Preetham et al., table 2).
const spectrum::Curve& ozone() {
    static const spectrum::Curve curve(
        {440, 460, 480, 500, 520, 540, 560, 580, 600, 620, 640, 660, 680, 700},
        {0, 0.006, 0.014, 0.030, 0.048, 0.075, 0.103, 0.120, 0.125, 0.090, 0.048, 0.018, 0.009, 0});
    return curve;
}

/// Planck's law for the sun's temperature, W/(sr m^2 nm).
double sun_radiance(double wavelength) {
    constexpr double KELVIN = 5772.0;               // IAU 2015, resolution B3
    constexpr double FIRST_RADIATION = 1.191043e20; // W nm^4 / (sr m^2)
    constexpr double SECOND_RADIATION = 1.438776877e7;
    return FIRST_RADIATION / std::pow(wavelength, 5.0) /
           std::expm1(SECOND_RADIATION / (wavelength * KELVIN));
}

/// How much of the sun's light reaches the ground: appendix A.1, without water vapour and mixed
/// gases, which absorb where eyes see little.
double transmittance(double wavelength, double mass, double turbidity) {
    constexpr double OZONE = 0.35; // centimetres
    const double micrometres = wavelength * 1e-3;
    const double rayleigh = 0.008735 * std::pow(micrometres, -4.08);
    const double haze = (0.04608 * turbidity - 0.04586) * std::pow(micrometres, -1.3);
    return std::exp(-mass * (rayleigh + haze + OZONE * ozone()(wavelength)));
}

glm::dvec3 sun_through_air(double zenith_angle, double turbidity) {
    const double mass = air_mass(zenith_angle), sine = std::sin(0.5 * SUN_ANGLE);
    const glm::dvec3 radiance = spectrum::color_of_light([&](double wavelength) {
        return sun_radiance(wavelength) * transmittance(wavelength, mass, turbidity);
    });
    return glm::max(radiance * (spectrum::integral_of_observer() * PI * sine * sine),
                    glm::dvec3(0.0));
}

/// A cubic of the sun's zenith angle whose coefficients are quadratic in the turbidity (A.2).
double zenith_chromaticity(const double (&rows)[3][4], double turbidity, double angle) {
    double value = 0.0;
    for (const auto& row : rows)
        value = value * turbidity + ((row[0] * angle + row[1]) * angle + row[2]) * angle + row[3];
    return value;
}

/// Of a plane that faces the zenith.
glm::dvec3 sky_irradiance(const DaylightModel& model) {
    constexpr int ROWS = 64, COLUMNS = 128; // of equal projected solid angle
    glm::dvec3 sum(0.0);
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < COLUMNS; j++) {
            const double cosine = std::sqrt((i + 0.5) / ROWS);
            sum += model.sky(direction_of(std::asin(cosine), 2.0 * PI * (j + 0.5) / COLUMNS));
        }
    return sum * (PI / (ROWS * COLUMNS));
}

} // namespace

double DaylightModel::Distribution::at(double cosine, double angle) const {
    const double near_sun = std::cos(angle);
    return (1.0 + a * std::exp(b / std::max(cosine, LEAST_COSINE))) *
           (1.0 + c * std::exp(d * angle) + e * near_sun * near_sun);
}

DaylightModel::DaylightModel(const Daylight& day)
    : to_sun_(direction_of(double(day.elevation), double(day.azimuth))) {
    const double t = double(day.turbidity);
    const double sun = 0.5 * PI - std::clamp(double(day.elevation), 0.0, 0.5 * PI);
    const double chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * sun);
    const double zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192; // kcd/m^2
    luminance_ = {0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251,
                  0.1206 * t - 2.5771, -0.0670 * t + 0.3703, 1000.0 * std::max(zenith, 0.0)};
    constexpr double X[3][4] = {{0.00166, -0.00375, 0.00209, 0.0},
                                {-0.02903, 0.06377, -0.03202, 0.00394},
                                {0.11693, -0.21196, 0.06052, 0.25886}};
    constexpr double Y[3][4] = {{0.00275, -0.00610, 0.00317, 0.0},
                                {-0.04214, 0.08970, -0.04153, 0.00516},
                                {0.15346, -0.26756, 0.06670, 0.26688}};
    x_ = {-0.0193 * t - 0.2592, -0.0665 * t + 0.0008, -0.0004 * t + 0.2125,
          -0.0641 * t - 0.8989, -0.0033 * t + 0.0452, zenith_chromaticity(X, t, sun)};
    y_ = {-0.0167 * t - 0.2608, -0.0950 * t + 0.0092, -0.0079 * t + 0.2102,
          -0.0441 * t - 1.6537, -0.0109 * t + 0.0529, zenith_chromaticity(Y, t, sun)};
    sun_irradiance_ = sun_through_air(sun, t);
    const double height = std::max(to_sun_.y, 0.0);
    ground_ = glm::dvec3(day.ground_albedo) *
              (sky_irradiance(*this) + (day.sun ? height : 0.0) * sun_irradiance_) / PI;
}

glm::dvec3 DaylightModel::sky(const glm::dvec3& direction) const {
    const double sun = std::acos(std::clamp(to_sun_.y, 0.0, 1.0));
    const double angle = std::acos(std::clamp(glm::dot(direction, to_sun_), -1.0, 1.0));
    const auto value = [&](const Distribution& f) {
        return f.zenith * f.at(direction.y, angle) / f.at(1.0, sun);
    };
    const double x = value(x_), y = value(y_), luminance = value(luminance_) / LUMENS_PER_WATT;
    return glm::max(
        spectrum::srgb_of_xyz({x / y * luminance, luminance, (1.0 - x - y) / y * luminance}),
        glm::dvec3(0.0));
}

glm::dvec3 DaylightModel::radiance(const glm::dvec3& direction) const {
    return direction.y < 0.0 ? ground_ : sky(direction);
}

Image daylight_map(const DaylightModel& model, uint32_t width) {
    Image map(width, width / 2, 3);
    tbb::parallel_for(0u, map.height, [&](uint32_t y) {
        const double elevation = PI * (0.5 - (y + 0.5) / map.height);
        for (uint32_t x = 0; x < map.width; x++) {
            const double azimuth = 2.0 * PI * ((x + 0.5) / map.width - 0.5);
            const glm::dvec3 radiance = model.radiance(direction_of(elevation, azimuth));
            for (glm::length_t c = 0; c < 3; c++) map.pixel(x, y)[c] = float(radiance[c]);
        }
    });
    return map;
}

DirectionalLight sun_light(const DaylightModel& model, float rotation) {
    const glm::dvec3& d = model.to_sun();
    const double cosine = std::cos(double(rotation)), sine = std::sin(double(rotation));
    const glm::dvec3 turned(cosine * d.x + sine * d.z, d.y, cosine * d.z - sine * d.x);
    return {.to_light = glm::vec3(glm::normalize(turned)),
            .irradiance = glm::vec3(model.sun_irradiance()),
            .angle = float(SUN_ANGLE)};
}

void add_daylight(Scene& scene, LoadContext& context, const std::string& name) {
    Environment& environment = scene.environment;
    if (!environment.sky || environment.map) return;
    context.spend(uint64_t(MAP_WIDTH) * (MAP_WIDTH / 2), ENVIRONMENT_PIXEL_BYTES, name);
    const DaylightModel model(*environment.sky);
    environment.map = daylight_map(model, MAP_WIDTH);
    if (!environment.sky->sun) return;
    DirectionalLight sun = sun_light(model, environment.rotation);
    sun.irradiance *= environment.radiance;
    sun.group = environment.group;
    scene.directional_lights.push_back(sun);
}

} // namespace onde
