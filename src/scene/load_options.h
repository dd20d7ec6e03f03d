// What a user may ask of a load, whatever the format. Every command that loads a scene shares it.
#pragma once

#include "core/enum_words.h"
#include "scene/camera.h"
#include "scene/light.h"
#include "scene/material.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace onde {

/// Whether a scene gets the neutral studio environment.
enum class Studio { automatic, on, off };

constexpr auto enum_words(Studio) {
    return std::array{EnumWord{Studio::automatic, "auto"}, EnumWord{Studio::on, "on"},
                      EnumWord{Studio::off, "off"}};
}

/// Whether a plane under the scene takes its shadow.
enum class GroundPlane { automatic, on, off };

constexpr auto enum_words(GroundPlane) {
    return std::array{EnumWord{GroundPlane::automatic, "auto"}, EnumWord{GroundPlane::on, "on"},
                      EnumWord{GroundPlane::off, "off"}};
}

/// What loading adds to a file by the size of what is in it (stage.h).
struct Stage {
    glm::dvec3 origin{0.0};         ///< of its positions, in the file's coordinates
    int exponent = 0;               ///< of two, by which all lengths are multiplied
    std::optional<Camera> camera{}; ///< of a file without one
    std::optional<float> ground{};  ///< height of the plane under it
};

struct LoadOptions {
    bool strict = false;          ///< refuse what would be repaired or dropped with a note
    std::filesystem::path root{}; ///< folder that references may not leave; empty: the file's own
    uint64_t limit = 0;           ///< bytes that a whole load may take; 0: a quarter of the memory
    std::optional<TextureFilter> texture_filter{}; ///< of all textures, else each one's own
    uint64_t texture_memory = UINT64_MAX; ///< bytes on the device that textures are lowered to

    // Of glTF files; a name, or a number from 0. Empty: the default.
    std::optional<double> at{}; ///< seconds of the animation; else the rest pose
    std::string animation{}, scene{}, variant{};
    std::optional<Environment> environment{}; ///< replaces the file's own
    std::optional<glm::uvec2> size{}; ///< pixels of the picture to be framed, else the file's own
    /// An added camera fits the scene at whatever angle it is turned about the vertical.
    bool all_round = false;
    std::optional<Stage> stage{}; ///< of an earlier load; else fitted to this one
    bool only_shapes = false;     ///< of glTF and TOML files: no textures, no maps
    /// automatic: for models (files that are not TOML), and for scenes in which nothing emits but,
    /// at most, small details in emission textures; never beside another environment.
    Studio studio = Studio::automatic;
    /// automatic: the file's own, or for models that bring no camera.
    GroundPlane ground = GroundPlane::automatic;
};

} // namespace onde
