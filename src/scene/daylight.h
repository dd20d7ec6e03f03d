// The sun and a cloudless sky: Preetham, Shirley and Smits 1999, A Practical Analytic Model for
// Daylight. In W/(sr m^2) of the luminance that the model states.
#pragma once

#include "scene/light.h"
#include "scene/load_context.h"
#include "scene/scene.h"

namespace onde {

/// The sun's disk, radians across.
inline constexpr double SUN_ANGLE = 0.53 * std::numbers::pi / 180.0;

/// Directions are those of Environment's map, before it is turned.
class DaylightModel {
  public:
    explicit DaylightModel(const Daylight& day);

    /// Unit, from the scene.
    const glm::dvec3& to_sun() const { return to_sun_; }

    /// What the sun alone, as it is seen through the air, gives to a surface that faces it: that of
    /// a black body, less what air, haze and ozone scatter and absorb.
    const glm::dvec3& sun_irradiance() const { return sun_irradiance_; }

    /// Of the sky, without the sun. `direction` is unit, and not below the horizon.
    glm::dvec3 sky(const glm::dvec3& direction) const;

    /// Of the ground, which is alike everywhere, in the light of both.
    const glm::dvec3& ground() const { return ground_; }

    /// Either, by where the direction points.
    glm::dvec3 radiance(const glm::dvec3& direction) const;

  private:
    /// How bright the sky is by direction (Perez et al. 1993), of luminance or chromaticity.
    struct Distribution {
        double a, b, c, d, e, zenith;

        /// Of a cosine to the zenith and an angle to the sun, but for a factor.
        double at(double cosine, double angle) const;
    };

    glm::dvec3 to_sun_, sun_irradiance_, ground_;
    Distribution luminance_, x_, y_;
};

/// An equirectangular map of the model's radiance.
Image daylight_map(const DaylightModel& model, uint32_t width);

/// The sun as a light, turned by `rotation` as Environment turns its map.
DirectionalLight sun_light(const DaylightModel& model, float rotation);

/// Draws the map of an environment that has a sky, which it spends as pixels of `name`, and puts
/// the sun among the lights.
void add_daylight(Scene& scene, LoadContext& context, const std::string& name);

} // namespace onde
