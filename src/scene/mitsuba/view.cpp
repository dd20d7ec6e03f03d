// Sensors, films and integrators of Mitsuba's files.
#include "scene/mitsuba/reader.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <cmath>

namespace onde::mitsuba {
namespace {

constexpr uint32_t WIDTH = 768, HEIGHT = 576, SAMPLES = 4; // Mitsuba's own

/// A whole number; the range is checked with the scene.
uint32_t count(double number) {
    return uint32_t(std::clamp(number, 0.0, 4294967295.0));
}

/// The tangent of half the vertical angle of view.
double half_height(const Values& values, double width, double height, Notes& notes) {
    constexpr double FILM_DIAGONAL = 43.266615305567875; // mm, of 35 mm film: 36 by 24
    const std::string axis = values.text("fov_axis", "x");
    const double aspect = width / height, diagonal = std::hypot(width, height);
    if (const auto fov = values.number("fov")) {
        const double half = std::tan(glm::radians(std::clamp(*fov, 0.001, 179.9)) / 2.0);
        if (axis == "y" || (axis == "smaller" && aspect > 1.0) ||
            (axis == "larger" && aspect < 1.0))
            return half;
        return axis == "diagonal" ? half * height / diagonal : half / aspect;
    }
    const std::string length = values.text("focal_length", "50mm");
    const auto numbers = numbers_of(std::string_view(length).substr(0, length.find('m')));
    const bool good = numbers.size() == 1 && numbers[0] > 0.0;
    if (!good) notes.wrong("Focal lengths that are none are 50mm", length);
    return FILM_DIAGONAL * height / diagonal / (2.0 * (good ? numbers[0] : 50.0));
}

} // namespace

void Reader::read_integrator(const Element& integrator, int depth) {
    constexpr int DEEPEST = 8;
    constexpr double MOST = 1023.0;
    if (const Element* inner = document_.child(integrator, "integrator"); inner && depth < DEEPEST)
        return read_integrator(*inner, depth + 1);
    const std::string& type = integrator["type"];
    RenderSettings& settings = scene_.assets().settings;
    if (type == "direct") {
        settings.depth = 2;
        return;
    }
    if (type != "path" && type != "volpath" && type != "aov")
        notes_.add("Other integrators than path are path", type);
    const double most = Values(document_, integrator).number("max_depth", -1.0);
    settings.depth = count(most < 0.0 ? MOST : std::clamp(most, 1.0, MOST));
}

void Reader::read_film(const Element& film) {
    const Values values(document_, film);
    RenderSettings& settings = scene_.assets().settings;
    settings.width = count(values.number("width", WIDTH));
    settings.height = count(values.number("height", HEIGHT));
    if (document_.property(film, "crop_width"))
        notes_.add("The whole picture is rendered, whatever its crop");
    settings.filter = Filter::gaussian;
    const Element* filter = document_.child(film, "rfilter");
    if (!filter) return;
    const std::string& type = (*filter)["type"];
    if (type == "gaussian") return;
    settings.filter = type == "box"    ? Filter::box
                      : type == "tent" ? Filter::tent
                                       : Filter::blackman_harris;
    if (settings.filter == Filter::blackman_harris)
        notes_.add("Pixel filters that take light away are Blackman-Harris", type);
}

void Reader::set_view(const Element& sensor, Camera& camera) {
    const Values values(document_, sensor);
    const RenderSettings& settings = scene_.assets().settings;
    const double width = std::max(1u, settings.width.value_or(WIDTH));
    const double height = std::max(1u, settings.height.value_or(HEIGHT));
    const std::string& type = sensor["type"];
    if (type == "orthographic") {
        camera.orthographic_height = float(2.0 * height / width); // x from -1 to 1
        return;
    }
    if (type != "perspective" && type != "thinlens")
        notes_.add("Sensors of other kinds are perspective", type);
    const double half = std::atan(half_height(values, width, height, notes_));
    camera.vertical_fov = float(std::clamp(2.0 * half, 1e-5, 3.14));
    camera.focus_distance = float(std::clamp(values.number("focus_distance", 1.0), 1e-6, 1e30));
    if (type == "thinlens")
        camera.aperture_radius =
            float(std::clamp(values.number("aperture_radius", 0.0), 0.0, 1e30));
    for (const char* name : {"principal_point_offset_x", "principal_point_offset_y"})
        if (values.number(name, 0.0) != 0.0) notes_.add("Views have their axis in the middle");
}

void Reader::read_sensor(const Element& sensor) {
    if (camera_to_world_) return notes_.add("Of several sensors the first counts");
    if (const Element* film = document_.child(sensor, "film")) read_film(*film);
    RenderSettings& settings = scene_.assets().settings;
    const Element* sampler = document_.child(sensor, "sampler");
    settings.samples =
        sampler ? count(Values(document_, *sampler).number("sample_count", SAMPLES)) : SAMPLES;
    const glm::dmat4 to_world = Values(document_, sensor).transform("to_world");
    const double volume = std::abs(glm::determinant(glm::dmat3(to_world)));
    if (!(volume > 0.0) || !std::isfinite(volume))
        return notes_.wrong("Sensors whose transform has no inverse are left out", sensor.where);
    camera_to_world_ = to_world;
    if (const auto around = medium_of(document_.child(sensor, "medium")))
        scene_.assets().medium = *around;
    Camera camera;
    set_view(sensor, camera);
    // Mitsuba's camera has +X to the left and looks along +Z.
    scene_.place_camera(camera, glm::scale(to_world, glm::dvec3(-1.0, 1.0, -1.0)));
}

} // namespace onde::mitsuba
