#include "scene/pbrt/spectrum.h"

#include "scene/measured.h"

#include "core/error.h"
#include "scene/text.h"

#include <algorithm>

namespace onde::pbrt {
namespace {

/// Indices of refraction at 587.6 nm, from the makers' data sheets.
struct Glass {
    std::string_view name;
    double index;
};
constexpr Glass GLASSES[] = {
    {"glass-BK7", 1.5168},   {"glass-BAF10", 1.67}, {"glass-F11", 1.6206},  {"glass-FK51A", 1.4866},
    {"glass-LASF9", 1.8503}, {"glass-SF5", 1.6727}, {"glass-SF10", 1.7283}, {"glass-SF11", 1.7847}};

Spectrum grey(double value) {
    return {.rgb = glm::dvec3(value)};
}

Spectrum of_curve(spectrum::Curve curve) {
    return {.curve = std::move(curve)};
}

/// "metal-Ag-eta" and its like.
std::optional<Spectrum> metal(std::string_view name) {
    if (!name.starts_with("metal-")) return std::nullopt;
    const size_t last = name.rfind('-');
    const auto index =
        last > 5 ? spectrum::conductor_index(name.substr(6, last - 6)) : std::nullopt;
    if (!index) return std::nullopt;
    const std::string_view part = name.substr(last + 1);
    if (part == "eta") return of_curve(index->eta);
    if (part == "k") return of_curve(index->k);
    return std::nullopt;
}

std::optional<Spectrum> named(std::string_view name) {
    for (const Glass& glass : GLASSES)
        if (glass.name == name) return grey(glass.index);
    if (name == "stdillum-D65" || name == "illum-acesD60") return Spectrum{.curve = spectrum::d65};
    if (name == "stdillum-A") return Spectrum{.curve = spectrum::black_body(2856.0)};
    return metal(name);
}

/// A file of pairs of a wavelength and a value.
std::optional<Spectrum> from_file(const std::string& name, const Sources& sources) {
    const auto path = sources.find(name, "Spectra");
    if (!path) return std::nullopt;
    constexpr uint64_t MAX_BYTES = uint64_t(1) << 20;
    const std::string bytes = read_file_within(sources.context, *path, MAX_BYTES);
    std::vector<double> numbers;
    text::Lines lines(bytes);
    while (const auto line = lines.next()) {
        text::Words words(*line);
        for (std::string_view word = words.next(); !word.empty(); word = words.next())
            numbers.push_back(text::number(word).value_or(NAN));
    }
    const auto curve = spectrum::curve_of_pairs(numbers);
    if (curve) return of_curve(*curve);
    sources.notes.wrong("Spectra that are no table of rising wavelengths are left out", name);
    return std::nullopt;
}

std::optional<Spectrum> of_spectrum(const Parameter& parameter, const Sources& sources) {
    if (parameter.texts.empty()) {
        if (parameter.numbers.size() == 1) return grey(parameter.numbers[0]);
        if (const auto curve = spectrum::curve_of_pairs(parameter.numbers)) return of_curve(*curve);
        sources.notes.wrong("Spectra that are no table of rising wavelengths are left out",
                            parameter.where);
        return std::nullopt;
    }
    const std::string& name = parameter.texts[0];
    if (const auto known = named(name)) return known;
    if (name.find('.') != std::string::npos) return from_file(name, sources);
    sources.notes.add("Named spectra that Onde does not have are left out", name);
    return std::nullopt;
}

} // namespace

std::optional<Spectrum> spectrum_of(const Parameters& parameters, std::string_view name,
                                    const Sources& sources) {
    const Parameter* found = parameters.find(name);
    if (!found || found->type == "texture") return std::nullopt;
    const std::vector<double>& numbers = found->numbers;
    if (found->type == "spectrum") return of_spectrum(*found, sources);
    if ((found->type == "rgb" || found->type == "color") && numbers.size() == 3)
        return Spectrum{.rgb = glm::dvec3(numbers[0], numbers[1], numbers[2])};
    if (found->type == "float" && numbers.size() == 1) return grey(numbers[0]);
    if (found->type == "blackbody" && !numbers.empty() && numbers[0] > 0.0)
        return Spectrum{.curve = spectrum::black_body(numbers[0])};
    sources.notes.wrong("Colours that are none are left out", found->where + ": " + found->name);
    return std::nullopt;
}

glm::vec3 surface_color(const Spectrum& s) {
    const glm::dvec3 color = s.rgb ? *s.rgb : spectrum::color_of_surface(s.curve);
    return glm::vec3(glm::clamp(color, 0.0, 1.0));
}

glm::vec3 light_color(const Spectrum& s) {
    if (s.rgb) return glm::vec3(glm::max(*s.rgb, 0.0));
    const glm::dvec3 color = spectrum::color_of_light(s.curve);
    const double luminance = spectrum::luminance(color);
    return luminance > 0.0 ? glm::vec3(glm::max(color / luminance, 0.0)) : glm::vec3(0.0f);
}

ConductorColors conductor_colors(const Spectrum& eta, const Spectrum& k) {
    const glm::dvec3 n = eta.rgb ? *eta.rgb : spectrum::color_of_surface(eta.curve);
    const glm::dvec3 absorbed = k.rgb ? *k.rgb : spectrum::color_of_surface(k.curve);
    ConductorColors colors;
    for (glm::length_t c = 0; c < 3; ++c) {
        colors.normal[c] =
            float(std::clamp(conductor_reflectance(1.0, n[c], absorbed[c]), 0.0, 1.0));
        colors.edge_tint[c] = float(edge_tint(n[c], absorbed[c]));
    }
    if (!eta.rgb && !k.rgb)
        colors.normal = surface_color({.curve = [&](double wavelength) {
            return conductor_reflectance(1.0, eta.curve(wavelength), k.curve(wavelength));
        }});
    return colors;
}

double yellow_index(const Spectrum& eta) {
    constexpr double YELLOW = 587.6; // nm
    return eta.rgb ? eta.rgb->y : eta.curve(YELLOW);
}

} // namespace onde::pbrt
