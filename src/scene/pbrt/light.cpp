#include "scene/pbrt/light.h"

#include "scene/load.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace onde::pbrt {
namespace {

constexpr double PI = std::numbers::pi;

class Lights {
  public:
    Lights(const Parameters& parameters, const glm::dmat4& to_world, ExactScene& scene,
           std::vector<SkyLight>& sky, const Sources& sources)
        : p_(parameters), to_world_(to_world), scene_(scene), sky_(sky), sources_(sources) {}

    void add(const std::string& kind) {
        if (kind == "point") return point();
        if (kind == "goniometric") return goniometric();
        if (kind == "spot") return spot();
        if (kind == "distant") return distant();
        if (kind == "infinite") return infinite();
        sources_.notes.add("Lights of kinds that Onde does not have are left out", kind);
    }

  private:
    /// The light's colour times its scale; `power` over `unit_power`, that of a light of luminance
    /// 1, where a parameter of that name asks for it.
    glm::vec3 strength(std::string_view name, std::string_view power, double unit_power) {
        const auto value = spectrum_of(p_, name, sources_);
        const glm::vec3 color = value ? light_color(*value) : glm::vec3(1.0f);
        double scale = p_.number("scale").value_or(1.0);
        if (const auto wanted = p_.number(power); wanted && *wanted > 0.0)
            scale *= *wanted / unit_power;
        const glm::dvec3 strength = glm::dvec3(color) * std::max(scale, 0.0);
        return glm::vec3(glm::min(strength, glm::dvec3(std::numeric_limits<float>::max())));
    }

    glm::dvec3 place(std::string_view name, const glm::dvec3& absent) {
        return p_.point(name).value_or(absent);
    }

    void point() {
        p_.find("filename");
        const PointLight light{.position = glm::vec3(0.0f),
                               .intensity = strength("I", "power", 4.0 * PI)};
        scene_.place_light(light, glm::translate(to_world_, place("from", glm::dvec3(0.0))));
    }

    /// Along -Y of the light's space, and from its +X on, of a picture whose own space has Y and Z
    /// exchanged. The most candela are those of a W/sr.
    static LightProfile profile_of(const Image& picture) {
        LightProfile profile;
        profile.rows = std::clamp(picture.height, 2u, MOST_PROFILE_STEPS / 2);
        profile.columns = std::clamp(2 * picture.width, 2u, MOST_PROFILE_STEPS);
        profile.candela.clear();
        for (uint32_t row = 0; row <= profile.rows; row++)
            for (uint32_t column = 0; column < profile.columns; column++) {
                const double v = PI * row / profile.rows, h = 2.0 * PI * column / profile.columns;
                const glm::dvec3 own(std::sin(v) * std::cos(h), -std::sin(v) * std::sin(h),
                                     -std::cos(v)); // x, z, y of the light's space
                const glm::vec3 pixel = pixel_at(picture, octahedral_uv(own));
                const double mean = (double(pixel.x) + double(pixel.y) + double(pixel.z)) / 3.0;
                profile.candela.push_back(float(std::min(mean, 1e30) * LUMENS_PER_WATT));
            }
        return profile;
    }

    void goniometric() {
        const auto file = p_.text("filename");
        const auto path = file ? sources_.find(*file, "Pictures") : std::nullopt;
        if (!path) return point();
        const Image picture = *load_environment_within(sources_.context, *path, 0.0f).map;
        PhotometricLight light{.profile = profile_of(picture)};
        double mean = 0.0;
        for (const float value : picture.pixels)
            mean += double(value) / double(picture.pixels.size());
        light.intensity = strength("I", "power", std::max(4.0 * PI * mean, 1e-30));
        scene_.place_light(light, glm::translate(to_world_, place("from", glm::dvec3(0.0))));
    }

    /// The unit vector from `to` to `from`; nothing, with a note, where they are the same.
    std::optional<glm::vec3> back(const glm::dvec3& from, const glm::dvec3& to) {
        const double length = glm::length(from - to);
        if (length > 0.0 && std::isfinite(length)) return glm::vec3((from - to) / length);
        sources_.notes.wrong("Lights without a direction are left out", p_.where());
        return std::nullopt;
    }

    void spot() {
        const glm::dvec3 from = place("from", glm::dvec3(0.0));
        const auto back = this->back(from, place("to", glm::dvec3(0, 0, 1)));
        if (!back) return;
        const double cone = std::clamp(p_.number("coneangle").value_or(30.0), 0.1, 180.0);
        const double rim = std::clamp(p_.number("conedeltaangle").value_or(5.0), 0.0, cone);
        const double outer = std::cos(glm::radians(cone)),
                     inner = std::cos(glm::radians(cone - rim));
        const double unit = 2.0 * PI * ((1.0 - inner) + (inner - outer) / 2.0);
        sources_.notes.add("Spots fade toward their rims as glTF's do");
        const SpotLight light{.position = glm::vec3(0.0f),
                              .back = *back,
                              .intensity = strength("I", "power", unit),
                              .half_angle = float(glm::radians(cone)),
                              .inner_angle = float(glm::radians(cone - rim))};
        scene_.place_light(light, glm::translate(to_world_, from));
    }

    void distant() {
        const auto back =
            this->back(place("from", glm::dvec3(0.0)), place("to", glm::dvec3(0, 0, 1)));
        if (!back) return;
        const DirectionalLight light{.to_light = *back,
                                     .irradiance = strength("L", "illuminance", 1)};
        scene_.place_light(light, to_world_);
    }

    void infinite() {
        SkyLight light{.radiance = strength("L", "illuminance", PI),
                       .light_to_world = glm::dmat3(to_world_)};
        if (p_.has("portal")) sources_.notes.add("Portals of infinite lights are ignored");
        if (const auto file = p_.text("filename")) {
            const auto path = sources_.find(*file, "Pictures");
            if (!path) return;
            if (p_.has("illuminance"))
                sources_.notes.add("The illuminance of a picture of the sky is as it is");
            light.picture = *load_environment_within(sources_.context, *path, 0.0f).map;
            light.shape = SkyShape::octahedral;
            if (light.picture.width != light.picture.height) {
                sources_.notes.add("Pictures of the sky that are not square are equirectangular, "
                                   "as in pbrt-v3");
                light.shape = SkyShape::equirectangular;
                light.light_to_world *= FROM_V3;
            }
        }
        sky_.push_back(std::move(light));
    }

    /// pbrt-v3's maps have +Z on top and begin at +X, from where they go on to +Y.
    static constexpr glm::dmat3 FROM_V3{glm::dvec3(0, -1, 0), glm::dvec3(0, 0, 1),
                                        glm::dvec3(1, 0, 0)};

    const Parameters& p_;
    const glm::dmat4& to_world_;
    ExactScene& scene_;
    std::vector<SkyLight>& sky_;
    const Sources& sources_;
};

} // namespace

void add_light(const std::string& kind, const Parameters& parameters, const glm::dmat4& to_world,
               ExactScene& scene, std::vector<SkyLight>& sky, const Sources& sources) {
    Lights(parameters, to_world, scene, sky, sources).add(kind);
    for (const std::string& unused : parameters.unused())
        sources.notes.add("Other parameters of lights are ignored", unused);
}

AreaLight area_light_of(const std::string& kind, const Parameters& parameters,
                        const Sources& sources) {
    if (kind != "diffuse")
        sources.notes.add("Area lights of other kinds than diffuse are diffuse", kind);
    const auto value = spectrum_of(parameters, "L", sources);
    const auto scale = float(std::max(parameters.number("scale").value_or(1.0), 0.0));
    AreaLight light;
    light.radiance = (value ? light_color(*value) : glm::vec3(1.0f)) * scale;
    light.two_sided = parameters.flag("twosided").value_or(false);
    for (const std::string& unused : parameters.unused())
        sources.notes.add("Other parameters of area lights are ignored", unused);
    return light;
}

} // namespace onde::pbrt
