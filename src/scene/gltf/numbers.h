// Numbers of glTF's materials as ours.
#pragma once

#include "scene/json_reader.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>

namespace onde::gltf {

inline float unit(double value) {
    return float(std::clamp(value, 0.0, 1.0));
}

template <size_t N>
glm::vec3 rgb(const std::array<double, N>& values) {
    return glm::vec3(values[0], values[1], values[2]);
}

/// A number of an optional part of a material.
inline double number_in(const std::optional<JsonReader>& part, const char* key, double fallback) {
    return part ? part->number(key, fallback) : fallback;
}

} // namespace onde::gltf
