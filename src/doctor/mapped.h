// Probes that are lane by lane, with inputs from their domains: what must not depend on the width.
#pragma once

#include "doctor/columns.h"

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

} // namespace onde::doctor
