// What a scene file may ask of a render; the command line overrides each.
#pragma once

#include "core/enum_words.h"
#include "image/display.h"
#include "scene/fields.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace onde {

enum class IntegratorKind : uint32_t { path, whitted, light, depth_buffer, painter };

constexpr auto enum_words(IntegratorKind) {
    return std::array{EnumWord{IntegratorKind::path, "path"},
                      EnumWord{IntegratorKind::whitted, "whitted"},
                      EnumWord{IntegratorKind::light, "light"},
                      EnumWord{IntegratorKind::depth_buffer, "depth-buffer"},
                      EnumWord{IntegratorKind::painter, "painter"}};
}

/// Whether what moves while the shutter is open is blurred; else it is as the shutter opens.
constexpr bool knows_time(IntegratorKind integrator) {
    return integrator == IntegratorKind::path || integrator == IntegratorKind::light;
}

enum class Filter : uint32_t { box, tent, gaussian, blackman_harris };

constexpr auto enum_words(Filter) {
    return std::array{EnumWord{Filter::box, "box"}, EnumWord{Filter::tent, "tent"},
                      EnumWord{Filter::gaussian, "gaussian"},
                      EnumWord{Filter::blackman_harris, "blackman-harris"}};
}

/// What is behind the scene: its environment, or nothing, with an alpha channel.
enum class Background { environment, transparent };

constexpr auto enum_words(Background) {
    return std::array{EnumWord{Background::environment, "environment"},
                      EnumWord{Background::transparent, "transparent"}};
}

/// How paths choose one of many lights.
enum class LightSampler {
    automatic, ///< by the tree where there are many lights that have a place
    power,     ///< by their power, whatever is lit
    tree,      ///< by what they may send to the point that is lit
};

constexpr auto enum_words(LightSampler) {
    return std::array{EnumWord{LightSampler::automatic, "auto"},
                      EnumWord{LightSampler::power, "power"}, EnumWord{LightSampler::tree, "tree"}};
}

/// What takes the noise from a picture.
enum class Denoiser {
    automatic,  ///< Open Image Denoise where its library is found, else our own
    open_image, ///< Open Image Denoise
    own,        ///< on the device
    off,
};

constexpr auto enum_words(Denoiser) {
    return std::array{EnumWord{Denoiser::automatic, "auto"}, EnumWord{Denoiser::open_image, "oidn"},
                      EnumWord{Denoiser::own, "onde"}, EnumWord{Denoiser::off, "off"}};
}

/// Of pictures whose scene states no size, pixels.
inline constexpr glm::uvec2 DEFAULT_FILM_SIZE{800, 600};

inline constexpr Range FILM_SIZE{.low = 1, .high = 65535};

struct RenderSettings {
    std::optional<uint32_t> width, height, samples, depth, seed;
    std::optional<Filter> filter;
    std::optional<float> exposure, noise, shutter;
    std::optional<ToneMap> tone_map;
    std::optional<IntegratorKind> integrator;
    std::optional<Background> background;
    std::optional<std::vector<std::string>> aov;
    std::optional<Denoiser> denoise;
    std::optional<float> clamp;
    std::optional<LightSampler> light_sampler;
};

/// The keys of [render]; [film] has width and height as one.
constexpr auto fields_of(TypeTag<RenderSettings>) {
    using S = RenderSettings;
    return std::tuple{
        field_without_key(&S::width, "width", {.range = FILM_SIZE}),
        field_without_key(&S::height, "height", {.range = FILM_SIZE}),
        field("samples", &S::samples, "per pixel", {.range = {.low = 1, .high = 1u << 24}}),
        field(
            "noise", &S::noise,
            "render until each pixel is, with 95 % probability, off by no more than this share of "
            "white as it is shown, whatever `samples` says",
            {.range = {.low = 0, .high = 1}}),
        field("depth", &S::depth, "the most surfaces that a path may visit",
              {.range = {.low = 1, .high = 1023}}),
        field("seed", &S::seed, "of the random numbers",
              {.range = {.low = 0, .high = 0xffffffffu}}),
        field("filter", &S::filter, "of the pixels"),
        field("exposure", &S::exposure, "stops", {.range = {.low = -64, .high = 64}}),
        field("tone_map", &S::tone_map, "how bright light is shown in a `.png`",
              {.absent = "`\"neutral\"`; `\"none\"` for the chapter's integrators"}),
        field("integrator", &S::integrator, "what is computed", {.absent = "`\"path\"`"}),
        field(
            "background", &S::background,
            "what rays of the camera see where there is nothing; `\"transparent\"` gives pictures "
            "an alpha channel",
            {.absent = "`\"environment\"`"}),
        field("aov", &S::aov, "further [channels](#channels) of the picture", {.absent = "none"}),
        field("denoise", &S::denoise, "what takes the noise from the picture",
              {.absent = "`\"off\"`"}),
        field("clamp", &S::clamp, "the most radiance of a sample",
              {.range = POSITIVE, .absent = "any"}),
        field("shutter", &S::shutter,
              "seconds for which the shutter is open, from the moment that is rendered on: what "
              "[moves](#motion) meanwhile is blurred",
              {.range = {.low = 0, .high = 1e6}, .absent = "`0`"}),
        field("light_sampler", &S::light_sampler,
              "how a path chooses one of [many lights](lights.md#many-lights)",
              {.absent = "`\"auto\"`"})};
}

} // namespace onde
