// Emitters of Mitsuba's files that are no surfaces.
#include "scene/daylight.h"
#include "scene/load.h"
#include "scene/mitsuba/reader.h"
#include "scene/spectrum/cie.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde::mitsuba {

glm::vec3 Reader::strength(const Element& emitter, std::string_view name) {
    const Values values(document_, emitter);
    if (const Element* found = document_.property(emitter, name); found && found->tag == "texture")
        notes_.add("Textures of emitters are left out", found->where);
    const glm::dvec3 color = values.color(name).value_or(glm::dvec3(1.0));
    return glm::vec3(glm::clamp(color, 0.0, double(std::numeric_limits<float>::max())));
}

void Reader::add_emitter(const Element& emitter) {
    const Values values(document_, emitter);
    const std::string& type = emitter["type"];
    const glm::dmat4 to_world = values.transform("to_world");
    if (type == "point") {
        const PointLight light{.position = glm::vec3(0.0f),
                               .intensity = strength(emitter, "intensity")};
        const glm::dvec3 position = values.vector("position", glm::dvec3(0.0));
        scene_.place_light(light, glm::translate(to_world, position));
    } else if (type == "directional") {
        const glm::dvec3 way = values.vector("direction", glm::dvec3(0, 0, 1));
        const glm::dvec3 toward = glm::dmat3(to_world) * way;
        if (!(glm::length(toward) > 0.0) || !std::isfinite(glm::length(toward)))
            return notes_.wrong("Lights without a direction are left out", emitter.where);
        const DirectionalLight light{.to_light = glm::vec3(-glm::normalize(toward)),
                                     .irradiance = strength(emitter, "irradiance")};
        scene_.place_light(light, glm::dmat4(1.0));
    } else if (type == "spot") {
        const double cutoff = std::clamp(values.number("cutoff_angle", 20.0), 0.1, 180.0);
        const double beam = std::clamp(values.number("beam_width", 0.75 * cutoff), 0.0, cutoff);
        notes_.add("Spots fade toward their rims as glTF's do", emitter.where);
        const SpotLight light{.position = glm::vec3(0.0f),
                              .back = {0.0f, 0.0f, -1.0f},
                              .intensity = strength(emitter, "intensity"),
                              .half_angle = float(glm::radians(cutoff)),
                              .inner_angle = float(glm::radians(beam))};
        scene_.place_light(light, to_world);
    } else if (type == "sunsky" || type == "sky" || type == "sun") {
        add_daylight(emitter);
    } else if (type == "constant" || type == "envmap") {
        add_sky(emitter);
    } else if (type != "area") { // which stands there for shapes to refer to
        notes_.add("Emitters of kinds that Onde does not have are left out", type);
    }
}

void Reader::add_sky(const Element& emitter) {
    const Values values(document_, emitter);
    if (emitter["type"] == "constant")
        return sky_.push_back({.radiance = strength(emitter, "radiance"),
                               .shape = SkyShape::uniform,
                               .picture = {},
                               .light_to_world = glm::dmat3(1.0)});
    const auto path = document_.find(values.text("filename"), "Pictures");
    if (!path) return;
    // Mitsuba's maps begin at -Z, where ours have their middle.
    const glm::dmat4 turned =
        glm::rotate(values.transform("to_world"), glm::radians(180.0), glm::dvec3(0, 1, 0));
    const auto scale = float(std::clamp(values.number("scale", 1.0), 0.0, 1e30));
    sky_.push_back({.radiance = glm::vec3(scale),
                    .shape = SkyShape::equirectangular,
                    .picture = *load_environment_within(context_, *path, 0.0f).map,
                    .light_to_world = glm::dmat3(turned)});
}

/// Where the sun is as the emitter sees it, with +Y up; 45 degrees high where only the date and the
/// hour are given.
static glm::dvec3 direction_of_sun(const Values& values, const glm::dmat3& to_world, Notes& notes,
                                   const std::string& where) {
    const glm::dvec3 stated =
        glm::transpose(to_world) * values.vector("sun_direction", glm::dvec3(0.0));
    const double length = glm::length(stated);
    if (length > 0.0 && std::isfinite(length)) return stated / length;
    notes.add("The sun's place is not found by date and hour: it stands 45 degrees high", where);
    return glm::normalize(glm::dvec3(0, 1, -1));
}

void Reader::add_daylight(const Element& emitter) {
    constexpr uint32_t WIDTH = 512;
    constexpr glm::dmat3 Y_UP{glm::dvec3(1, 0, 0), glm::dvec3(0, 0, 1), glm::dvec3(0, -1, 0)};
    const Values values(document_, emitter);
    const glm::dmat3 to_world = turn_of(glm::dmat3(values.transform("to_world"))) * Y_UP;
    const glm::dvec3 sun = direction_of_sun(values, to_world, notes_, emitter.where);
    const double turbidity = values.number("turbidity", 3.0);
    if (turbidity < 2.0) notes_.add("Skies of a turbidity below 2 have one of 2", emitter.where);
    values.color("albedo"); // what is below the horizon is black, and does not light the sky
    const DaylightModel model({.elevation = float(std::asin(std::clamp(sun.y, 0.0, 1.0))),
                               .azimuth = float(std::atan2(sun.x, -sun.z)),
                               .turbidity = float(std::clamp(turbidity, 2.0, 10.0)),
                               .ground_albedo = glm::vec3(0.0f)});
    notes_.add("Skies are those of Preetham, Shirley and Smits", emitter.where);
    // Its colours are means over wavelengths.
    const auto scale = [&](const char* name) {
        const double stated = std::clamp(values.number(name, 1.0), 0.0, 1e30);
        return float(stated / spectrum::integral_of_observer());
    };
    if (emitter["type"] != "sun") {
        context_.spend(uint64_t(WIDTH) * (WIDTH / 2), ENVIRONMENT_PIXEL_BYTES, name_);
        sky_.push_back({.radiance = glm::vec3(scale("sky_scale")),
                        .shape = SkyShape::equirectangular,
                        .picture = daylight_map(model, WIDTH),
                        .light_to_world = to_world});
    }
    if (emitter["type"] != "sky" && sun.y > 0.0) {
        const double angle = std::clamp(values.number("sun_aperture", 0.5338), 0.0, 180.0);
        scene_.place_light(
            DirectionalLight{.to_light = glm::vec3(to_world * sun),
                             .irradiance = glm::vec3(model.sun_irradiance()) * scale("sun_scale"),
                             .angle = float(glm::radians(angle))},
            glm::dmat4(1.0));
    }
}

} // namespace onde::mitsuba
