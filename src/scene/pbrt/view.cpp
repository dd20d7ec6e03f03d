#include "scene/pbrt/view.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace onde::pbrt {
namespace {

constexpr uint32_t WIDTH = 1280, HEIGHT = 720, SAMPLES = 16, BOUNCES = 5; // pbrt's own

/// A whole number as a file states it; the range is checked with the scene.
std::optional<uint32_t> count(const Parameters& parameters, std::string_view name) {
    const auto number = parameters.number(name);
    if (!number) return std::nullopt;
    return uint32_t(std::clamp(*number, 0.0, 4294967295.0));
}

void read_film(const Parameters& parameters, RenderSettings& settings, Notes& notes) {
    settings.width = count(parameters, "xresolution").value_or(WIDTH);
    settings.height = count(parameters, "yresolution").value_or(HEIGHT);
    for (const char* name : {"cropwindow", "pixelbounds"})
        if (parameters.has(name)) notes.add("The whole picture is rendered, whatever its crop");
    for (const char* name : {"iso", "exposuretime", "sensor", "whitebalance"})
        if (parameters.has(name)) notes.add("Films are the eye's, of exposure 1", name);
    for (const char* name : {"filename", "diagonal", "savefp16"}) parameters.find(name);
}

void read_sampler(const std::string& kind, const Parameters& parameters, RenderSettings& settings) {
    for (const char* name : {"randomization", "jitter"}) parameters.find(name);
    if (kind == "stratified") {
        const auto x = count(parameters, "xsamples"), y = count(parameters, "ysamples");
        settings.samples =
            uint32_t(std::min(uint64_t(x.value_or(4)) * y.value_or(4), uint64_t(1) << 31));
        return;
    }
    settings.samples = count(parameters, "pixelsamples").value_or(SAMPLES);
    settings.seed = count(parameters, "seed");
}

/// pbrt counts bounces, Onde surfaces.
void read_integrator(const std::string& kind, const Parameters& parameters,
                     RenderSettings& settings, Notes& notes) {
    constexpr uint32_t MOST = 1023;
    if (!kind.ends_with("path")) notes.add("Other integrators than path are path", kind);
    const uint32_t bounces = count(parameters, "maxdepth").value_or(BOUNCES);
    settings.depth = std::min(bounces, MOST - 1) + 1;
}

void read_filter(const std::string& kind, const Parameters& parameters, RenderSettings& settings,
                 Notes& notes) {
    struct Known {
        std::string_view kind;
        Filter filter;
        double radius, own_radius; ///< where none is stated, and Onde's
    };
    static constexpr Known KNOWN[] = {{"box", Filter::box, 0.5, 0.5},
                                      {"triangle", Filter::tent, 2.0, 1.0},
                                      {"gaussian", Filter::gaussian, 1.5, 1.5},
                                      {"mitchell", Filter::blackman_harris, 2.0, 1.5},
                                      {"sinc", Filter::blackman_harris, 4.0, 1.5}};
    const auto known = std::ranges::find(KNOWN, kind, &Known::kind);
    if (known == std::end(KNOWN)) return notes.add("Other pixel filters are Gaussian", kind);
    settings.filter = known->filter;
    if (known->filter == Filter::blackman_harris)
        notes.add("Pixel filters that take light away are Blackman-Harris", kind);
    for (const char* name : {"xradius", "yradius"})
        if (parameters.number(name).value_or(known->radius) != known->own_radius)
            notes.add("Pixel filters have the width that Onde gives them", kind);
}

/// What the camera sees at the distance 1, before its angle counts: x and y from and to.
std::array<double, 4> window_of(const Parameters& parameters, const RenderSettings& settings) {
    const std::vector<double>& stated = parameters.numbers("screenwindow");
    if (stated.size() == 4 && stated[0] < stated[1] && stated[2] < stated[3])
        return {stated[0], stated[1], stated[2], stated[3]};
    const double own = double(settings.width.value_or(WIDTH)) /
                       std::max(1.0, double(settings.height.value_or(HEIGHT)));
    const double aspect = std::max(parameters.number("frameaspectratio").value_or(own), 1e-6);
    const double x = std::max(aspect, 1.0), y = std::max(1.0 / aspect, 1.0);
    return {-x, x, -y, y};
}

/// A view whose axis is not in the middle of the picture.
ScreenWindow off_centre(const std::array<double, 4>& window, double scale,
                        const RenderSettings& settings) {
    const glm::dvec2 low(window[0] * scale, window[2] * scale);
    const glm::dvec2 size(window[1] * scale - low.x, window[3] * scale - low.y);
    const glm::dvec2 pixels(settings.width.value_or(WIDTH), settings.height.value_or(HEIGHT));
    return {.size = glm::vec2(size),
            .distance = 1.0f,
            .first_pixel = glm::vec2(low + 0.5 * size / pixels)};
}

} // namespace

void read_setting(std::string_view directive, const std::string& kind, const Parameters& parameters,
                  RenderSettings& settings, Notes& notes) {
    if (directive == "Film") read_film(parameters, settings, notes);
    if (directive == "Sampler") read_sampler(kind, parameters, settings);
    if (directive == "Integrator") read_integrator(kind, parameters, settings, notes);
    if (directive == "PixelFilter") read_filter(kind, parameters, settings, notes);
}

void complete_settings(RenderSettings& settings) {
    settings.width = settings.width.value_or(WIDTH);
    settings.height = settings.height.value_or(HEIGHT);
    settings.samples = settings.samples.value_or(SAMPLES);
    settings.depth = settings.depth.value_or(BOUNCES + 1);
    settings.filter = settings.filter.value_or(Filter::gaussian);
}

Camera camera_of(const std::string& kind, const Parameters& parameters,
                 const RenderSettings& settings, Notes& notes) {
    Camera camera;
    const auto window = window_of(parameters, settings);
    const bool centred = window[0] == -window[1] && window[2] == -window[3];
    camera.focus_distance =
        float(std::clamp(parameters.number("focaldistance").value_or(1e6), 1e-6, 1e30));
    if (kind == "orthographic") {
        camera.orthographic_height = float(window[3] - window[2]);
        if (!centred) notes.add("Orthographic views have their axis in the middle");
        return camera;
    }
    if (kind == "spherical") {
        camera.projection = Projection::panorama;
        if (parameters.text("mapping").value_or("equalarea") != "equirectangular")
            notes.add("Spherical cameras of equal areas are equirectangular");
        notes.add("Panoramas have the view axis in their middle, and are not mirrored");
        return camera;
    }
    if (kind != "perspective") notes.add("Cameras of other kinds are perspective", kind);
    camera.aperture_radius = float(std::max(parameters.number("lensradius").value_or(0.0), 0.0));
    const double fov = std::clamp(parameters.number("fov").value_or(90.0), 0.001, 179.9);
    const double scale = std::tan(glm::radians(fov) / 2.0);
    if (centred)
        camera.vertical_fov = float(std::clamp(2.0 * std::atan(window[3] * scale), 1e-5, 3.14));
    else
        camera.screen = off_centre(window, scale, settings);
    return camera;
}

} // namespace onde::pbrt
