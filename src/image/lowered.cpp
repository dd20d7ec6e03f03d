#include "image/lowered.h"

#include "image/texel_format.h"
#include "image/tone.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace onde {
namespace {

/// The texels of one side that a coarser one covers: from `first` on, `weights` that sum to 1.
struct Cover {
    uint32_t first;
    std::vector<float> weights;
};

std::vector<Cover> covers(uint32_t fine, uint32_t coarse) {
    std::vector<Cover> all(coarse);
    const double step = double(fine) / coarse;
    for (uint32_t i = 0; i < coarse; i++) {
        const double begin = i * step, end = std::min((i + 1) * step, double(fine));
        all[i].first = uint32_t(begin);
        for (uint32_t k = all[i].first; k < end; k++)
            all[i].weights.push_back(
                float((std::min(end, k + 1.0) - std::max(begin, double(k))) / step));
    }
    return all;
}

using Channels = std::array<float, 4>;

/// Linear values of texels, those of 8 bits by a table.
class LinearTexels {
  public:
    LinearTexels(const TexelImage& image, bool srgb)
        : image_(image), srgb_(srgb), has_table_(image.low.empty() && !image.is_linear()) {
        for (size_t i = 0; i < table_.size(); i++) {
            const float stored = float(i) / 255.0f;
            table_[i] = srgb ? linear_from_srgb(stored) : stored;
        }
    }
    /// Of the texel that begins with that sample.
    Channels operator()(size_t at) const {
        const auto color = [&](size_t i) {
            return has_table_ ? table_[image_.rgba[i]] : linear_sample(image_, i, srgb_);
        };
        return {color(at), color(at + 1), color(at + 2), image_.sample(at + 3)};
    }

  private:
    const TexelImage& image_;
    bool srgb_, has_table_;
    std::array<float, 256> table_;
};

/// Adds a texel to a picture that is stored as `like` is.
void append(TexelImage& image, const TexelImage& like, const Channels& linear, bool srgb,
            bool halves) {
    for (size_t k = 0; k < 4; k++) {
        if (like.is_linear()) {
            image.floats.push_back(halves ? nearest_half(linear[k]) : linear[k]);
            continue;
        }
        const float stored = srgb && k < 3 ? srgb_from_linear(linear[k]) : linear[k];
        const float clamped = std::clamp(stored, 0.0f, 1.0f);
        if (like.low.empty()) {
            image.rgba.push_back(uint8_t(std::lround(clamped * 255.0f)));
            continue;
        }
        const auto code = uint32_t(std::lround(clamped * 65535.0f));
        image.rgba.push_back(uint8_t(code >> 8));
        image.low.push_back(uint8_t(code));
    }
}

} // namespace

TexelImage lowered(const TexelImage& image, uint32_t width, uint32_t height, bool srgb) {
    const std::vector<Cover> columns = covers(image.width, width),
                             rows = covers(image.height, height);
    const LinearTexels texels(image, srgb);
    const bool halves = texel_format(image) == TexelFormat::halves;
    TexelImage result;
    result.width = width;
    result.height = height;
    for (const Cover& row : rows)
        for (const Cover& column : columns) {
            Channels sum{};
            for (size_t y = 0; y < row.weights.size(); y++)
                for (size_t x = 0; x < column.weights.size(); x++) {
                    const float weight = row.weights[y] * column.weights[x];
                    const Channels c =
                        texels(4 * ((row.first + y) * image.width + column.first + x));
                    for (size_t k = 0; k < 4; k++) sum[k] += weight * c[k];
                }
            append(result, image, sum, srgb, halves);
        }
    return result;
}

} // namespace onde
