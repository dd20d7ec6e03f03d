// Sun and sky: the model's numbers, the map that is drawn of it, and scenes that ask for it.
#include "scene/daylight.h"
#include "scene/scratch.h"
#include "scene/spectrum/cie.h"

#include <cmath>

using namespace onde;
using namespace onde::test;

namespace {

constexpr double PI = std::numbers::pi;

Daylight day(double elevation, double turbidity = 3) {
    return {.elevation = float(elevation * PI / 180), .turbidity = float(turbidity)};
}

double luminance(const glm::dvec3& color) {
    return spectrum::luminance(color) * LUMENS_PER_WATT;
}

/// Of elevation and azimuth, degrees.
glm::dvec3 toward(double elevation, double azimuth) {
    const double e = elevation * PI / 180, a = azimuth * PI / 180;
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

const std::string SHAPE = "[[shape]]\ntype = \"sphere\"\n";
const std::string SKY = SHAPE +
                        "[environment]\nsky = { elevation = 40, azimuth = 90, turbidity = 4 }\n"
                        "radiance = 0.5\nrotation = 30\ngroup = \"day\"\n";

} // namespace

TEST_CASE("the zenith of a clear sky is as bright as the model says") {
    // Preetham et al., appendix A.2, with the sun 45 degrees high: chi is 0.41944 pi / 2.
    const double chi = (4.0 / 9 - 3.0 / 120) * PI / 2;
    const double expected = 1000 * ((4.0453 * 3 - 4.9710) * std::tan(chi) - 0.2155 * 3 + 2.4192);
    CHECK(luminance(DaylightModel(day(45)).sky({0, 1, 0})) == Approx(expected).epsilon(1e-3));
    CHECK(expected == Approx(7330).epsilon(0.01));
}

TEST_CASE("the sky is brightest about the sun, and its horizon brighter than its zenith") {
    const DaylightModel model(day(30));
    const auto at = [&](double elevation, double azimuth) {
        return luminance(model.sky(toward(elevation, azimuth)));
    };
    CHECK(at(30, 0) > at(45, 0));
    CHECK(at(45, 0) > at(90, 0));
    CHECK(at(1, 180) > at(60, 180));
    CHECK(at(30, 90) == Approx(at(30, -90)));
    const glm::dvec3 blue = model.sky(toward(70, 180));
    CHECK(blue.z > 1.5 * blue.x);
}

TEST_CASE("sun and sky light the ground as they do outdoors") {
    // A clear noon has about 100 klx, of which the sky gives a tenth or two; the low sun is red.
    const DaylightModel noon(day(60, 2.5)), evening(day(3, 2.5));
    const double sun = luminance(noon.sun_irradiance()) * std::sin(PI / 3);
    CHECK(sun > 60e3);
    CHECK(sun < 110e3);
    double sky = 0;
    constexpr int ROWS = 90;
    for (int i = 0; i < ROWS; i++)
        for (int j = 0; j < 4 * ROWS; j++) {
            const double e = (i + 0.5) * 90 / ROWS;
            sky += luminance(noon.sky(toward(e, 360.0 * j / (4 * ROWS)))) * std::sin(e * PI / 180) *
                   std::cos(e * PI / 180) * (PI / 2 / ROWS) * (2 * PI / (4 * ROWS));
        }
    CHECK(sky > 6e3);
    CHECK(sky < 30e3); // the model's are bright
    const glm::dvec3 low = evening.sun_irradiance(), high = noon.sun_irradiance();
    CHECK(luminance(low) < 0.2 * luminance(high));
    CHECK(low.x / low.z > 3 * high.x / high.z);
    // The ground shows its albedo's share of both.
    CHECK(luminance(noon.ground()) == Approx(0.2 * (sun + sky) / PI).epsilon(0.01));
}

TEST_CASE("a map of the sky gives as much light as the model") {
    const Daylight low = day(15, 6);
    const DaylightModel model(low);
    const Image map = daylight_map(model, 512);
    double drawn = 0, stated = 0;
    for (uint32_t y = 0; y < map.height / 2; y++) {
        const double sine = std::sin(PI * (y + 0.5) / map.height) * (PI / map.height);
        for (uint32_t x = 0; x < map.width; x++) {
            const auto pixel = map.pixel(x, y);
            drawn += luminance({pixel[0], pixel[1], pixel[2]}) * sine * 2 * PI / map.width;
        }
    }
    constexpr int STEPS = 400; // by the sine of the elevation, of equal solid angle
    for (int i = 0; i < STEPS; i++)
        for (int j = 0; j < STEPS; j++) {
            const double e = std::asin((i + 0.5) / STEPS) * 180 / PI;
            stated += luminance(model.sky(toward(e, 360.0 * (j + 0.5) / STEPS)));
        }
    stated *= 2 * PI / STEPS / STEPS;
    CHECK(drawn == Approx(stated).epsilon(2e-3));
    const auto nadir = map.pixel(7, map.height - 1);
    CHECK(double(nadir[1]) == Approx(model.ground().y));
}

TEST_CASE("a scene's sky is a map and a sun, turned and dimmed together") {
    const ScratchFolder folder;
    const Scene scene = load_scene(folder.write("a.toml", SKY));
    REQUIRE(scene.environment.map);
    REQUIRE(scene.directional_lights.size() == 1);
    const DirectionalLight& sun = scene.directional_lights[0];
    CHECK(sun.group == "day");
    CHECK(double(sun.angle) == Approx(SUN_ANGLE));
    const DaylightModel model(*scene.environment.sky);
    CHECK(double(sun.irradiance.y) == Approx(0.5 * model.sun_irradiance().y));
    // The map's brightest pixel is where the sun is, once it is turned.
    const Image& map = *scene.environment.map;
    const auto brightest = std::ranges::max_element(map.pixels) - map.pixels.begin();
    const auto x = double(brightest / 3 % map.width), y = double(brightest / 3 / map.width);
    const double azimuth = (x + 0.5) / map.width * 360 - 180 - 30;
    const glm::dvec3 at = toward(90 - (y + 0.5) / map.height * 180, azimuth);
    CHECK(glm::dot(at, glm::dvec3(sun.to_light)) > std::cos(0.02));
    CHECK(glm::length(glm::dvec3(sun.to_light) - toward(40, 60)) < 1e-6);
}

TEST_CASE("a sky may be without its sun, and is nothing where another environment is asked for") {
    const ScratchFolder folder;
    const Scene sky =
        load_scene(folder.write("a.toml", SHAPE + "[environment]\nsky = { sun = false }\n"));
    CHECK(sky.environment.map);
    CHECK(sky.directional_lights.empty());
    LoadOptions options;
    options.environment = Environment{.radiance = glm::vec3(1), .map = {}};
    const Scene other = load_scene(folder.write("b.toml", SKY), options);
    CHECK_FALSE(other.environment.map);
    CHECK(other.directional_lights.empty());
}

TEST_CASE("a sky that is wrong is refused by its key") {
    const auto refused = [](const std::string& table) {
        const ScratchFolder folder;
        return load_error(folder.write("a.toml", "[environment]\n" + table));
    };
    CHECK_THAT(refused("sky = { elevation = -1 }"), Catch::Contains("elevation"));
    CHECK_THAT(refused("sky = { turbidity = 1 }"), Catch::Contains("must lie between 2 and 10"));
    CHECK_THAT(refused("sky = { ground_albedo = 1.5 }"), Catch::Contains("ground_albedo"));
    CHECK_THAT(refused("sky = { clouds = 1 }"), Catch::Contains("clouds"));
    CHECK_THAT(refused("sky = {}\nmap = \"a.hdr\""), Catch::Contains("can't go with sky"));
}
