// Formulas in double precision, against which the kernels' are held.
#pragma once

#include "scene/material.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <cmath>
#include <complex>

namespace onde::doctor {

/// The angle of (x, y) in turns, in [0, 1).
inline double turns_of(double y, double x) {
    const double turns = std::atan2(y, x) / (2 * M_PI);
    return turns < 0 ? turns + 1 : turns;
}

/// Of a smooth boundary: Born and Wolf, Principles of Optics, section 1.5.2, with complex numbers
/// so that total reflection needs no case of its own.
inline double reflectance(double cosine, double eta) {
    using Complex = std::complex<double>;
    const Complex below = std::sqrt(Complex(1 - (1 - cosine * cosine) / (eta * eta)));
    const Complex p = (eta * cosine - below) / (eta * cosine + below);
    const Complex s = (cosine - eta * below) / (cosine + eta * below);
    return (std::norm(p) + std::norm(s)) / 2;
}

/// Which texel a wrap mode reads for index i of `size`.
inline size_t wrap_index(int64_t i, int64_t size, Wrap wrap) {
    const auto modulo = [](int64_t a, int64_t n) { return (a % n + n) % n; };
    if (wrap == Wrap::repeat) return size_t(modulo(i, size));
    if (wrap == Wrap::clamp) return size_t(std::clamp(i, int64_t(0), size - 1));
    const int64_t folded = modulo(i, 2 * size);
    return size_t(folded < size ? folded : 2 * size - 1 - folded);
}

/// A sample as a linear number; codes of colours are sRGB, and data end at 1.
inline double exact_sample(const TexelImage& image, size_t at, bool color) {
    if (image.is_linear()) return color ? image.floats[at] : std::min(image.floats[at], 1.0f);
    const double c = image.code(at) / 65535.0;
    if (!color) return c;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

/// A bilinear lookup.
inline double look_up(const Texture& texture, double u, double v, size_t channel, bool color) {
    const TexelImage& image = texture.image;
    const double x = u * image.width - 0.5, y = v * image.height - 0.5;
    const auto x0 = int64_t(std::floor(x)), y0 = int64_t(std::floor(y));
    double sum = 0;
    for (int64_t j = 0; j < 2; j++)
        for (int64_t i = 0; i < 2; i++) {
            const double weight = (1 - std::abs(x - double(x0 + i))) * //
                                  (1 - std::abs(y - double(y0 + j)));
            const size_t column = wrap_index(x0 + i, image.width, texture.wrap_u);
            const size_t row = wrap_index(y0 + j, image.height, texture.wrap_v);
            sum += weight * exact_sample(image, 4 * (row * image.width + column) + channel, color);
        }
    return sum;
}

} // namespace onde::doctor
