// Probes that are lane by lane, with inputs from their domains: what must not depend on the width.
#pragma once

#include "doctor/columns.h"

#include <utility>

namespace onde::doctor {

struct Mapped {
    std::string name;
    size_t words; ///< of output
    Columns in;
};

/// Groups with no lane and with all lanes are among them.
inline Column random_condition(Generator& generator, size_t count) {
    Column column(count);
    for (size_t i = 0; i < count; i++) {
        const size_t group = i / 16;
        const float share = group % 8 == 0 ? 0.0f : group % 8 == 1 ? 1.0f : 0.3f;
        column[i] = unit(generator) < share ? 1.0f : 0.0f;
    }
    return column;
}

inline uint32_t bits_of_group(const Column& condition, size_t item, uint32_t width) {
    const size_t first = item / width * width;
    uint32_t bits = 0;
    for (uint32_t k = 0; k < width; k++) bits |= uint32_t(condition[first + k] != 0) << k;
    return bits;
}

/// Of kernels/probe/basics.cl.
inline std::vector<Mapped> mapped_basics(size_t count) {
    Generator generator(31);
    const auto uniform = [&](float low, float high) {
        return uniform_column(generator, count, low, high);
    };
    const auto words = [&] {
        Column column(count);
        for (float& a : column) a = word(uint32_t(generator()));
        return column;
    };
    Columns basis;
    add_vectors(basis, unit_vectors(generator, count));
    add_vectors(basis, unit_vectors(generator, count));
    return {
        {"math", 6, {uniform(-3, 3), uniform(-1, 1), uniform(-1, 1), words()}},
        {"basis", 15, basis},
        {"random", 2, {words(), words(), word_column(count, 9), word_column(count, 5)}},
        {"sampling", 15, {uniform(0, 1), uniform(0, 1), uniform(0, 2)}},
        {"heuristic", 1, {uniform(0, 10), uniform(0, 10)}},
        {"fresnel",
         4,
         {uniform(0, 1), uniform(0.5f, 2), uniform(0, 1), uniform(0, 1), uniform(0, 1),
          uniform(0, 1)}},
    };
}

/// BSDFs of every kind, smooth and rough, side by side in the lanes; wo; then 3 numbers or wi.
inline Columns mixed_bsdfs(size_t count, bool with_wi) {
    Generator generator(37);
    Columns in(11, Column(count));
    for (size_t i = 0; i < count; i++) {
        const uint32_t kind = uint32_t(generator()) % 4;
        for (size_t k = 0; k < 6; k++) in[k][i] = unit(generator);
        in[6][i] = kind == 0 ? 0.0f : 1.0f;
        in[7][i] = generator() % 4 == 0 ? 0.0f : unit(generator);
        in[8][i] = kind == 0 ? 0.0f : kind == 1 ? 1.0f : 0.1f + 0.8f * unit(generator);
        in[9][i] = generator() % 2 ? 1.5f : 1 / 1.5f;
        in[10][i] = kind == 3 ? 1.0f : 0.0f;
    }
    std::vector<glm::vec3> wo = unit_vectors(generator, count);
    for (glm::vec3& v : wo) v.z = std::max(std::abs(v.z), 1e-4f);
    add_vectors(in, wo);
    if (with_wi)
        add_vectors(in, unit_vectors(generator, count));
    else
        for (int k = 0; k < 3; k++) in.push_back(uniform_column(generator, count));
    return in;
}

/// Of kernels/probe/bsdf.cl.
inline std::vector<Mapped> mapped_bsdfs(size_t count) {
    return {{"bsdf_eval", 4, mixed_bsdfs(count, true)},
            {"bsdf_sample", 9, mixed_bsdfs(count, false)}};
}

/// All of them by their file.
inline std::vector<std::pair<std::string, std::vector<Mapped>>> lane_by_lane(size_t count) {
    return {{"basics.cl", mapped_basics(count)}, {"bsdf.cl", mapped_bsdfs(count)}};
}

} // namespace onde::doctor
