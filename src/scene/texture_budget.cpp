#include "scene/texture_budget.h"

#include "image/lowered.h"
#include "image/texel_format.h"
#include "scene/texture_levels.h"

#include <fmt/format.h>

#include <algorithm>
#include <queue>

namespace onde {
namespace {

/// A picture on its way to fewer texels.
struct Lowering {
    size_t texture;
    uint32_t width, height;
    uint32_t texel_bytes;
    bool has_levels;

    uint64_t bytes() const {
        return texel_bytes *
               (has_levels ? texels_of_levels(width, height) : uint64_t(width) * height);
    }
    bool can_go_on() const { return std::max(width, height) > LEAST_TEXTURE_SIDE; }
    void halve() {
        width = std::max((width + 1) / 2, 1u);
        height = std::max((height + 1) / 2, 1u);
    }
    /// The first texture first among equals, so that all machines do the same.
    bool operator<(const Lowering& other) const {
        return bytes() != other.bytes() ? bytes() < other.bytes() : texture > other.texture;
    }
};

std::vector<Lowering> pictures_of(const Scene& scene) {
    const std::vector<bool> with_levels = pictures_with_levels(scene);
    std::vector<Lowering> pictures;
    for (size_t i = 0; i < scene.textures.size(); i++) {
        const TexelImage& image = scene.textures[i].image;
        const auto texel_bytes = uint32_t(texel_words(image) * sizeof(uint32_t));
        if (!image.empty())
            pictures.push_back({i, image.width, image.height, texel_bytes, with_levels[i]});
    }
    return pictures;
}

} // namespace

void lower_textures(Scene& scene, uint64_t bytes) {
    constexpr double MEBI = 1 << 20;
    const std::vector<Lowering> pictures = pictures_of(scene);
    uint64_t before = 0;
    for (const Lowering& picture : pictures) before += picture.bytes();
    if (before <= bytes) return;
    std::priority_queue<Lowering> left;
    for (const Lowering& picture : pictures)
        if (picture.can_go_on()) left.push(picture);
    uint64_t taken = before;
    std::vector<Lowering> done(scene.textures.size());
    while (taken > bytes && !left.empty()) {
        Lowering largest = left.top();
        left.pop();
        taken -= largest.bytes();
        largest.halve();
        taken += largest.bytes();
        done[largest.texture] = largest;
        if (largest.can_go_on()) left.push(largest);
    }
    size_t count = 0;
    for (const Lowering& l : done) {
        if (l.width == 0) continue;
        Texture& texture = scene.textures[l.texture];
        texture.image = lowered(texture.image, l.width, l.height, texture.srgb);
        count++;
    }
    scene.notes.push_back(fmt::format(
        "Textures take {:.4g} MiB, more than --texture-memory says: {} of {} pictures have fewer "
        "texels now, and all take {:.4g} MiB{}.",
        double(before) / MEBI, count, pictures.size(), double(taken) / MEBI,
        taken > bytes ? fmt::format("; none is made smaller than {0} x {0}", LEAST_TEXTURE_SIDE)
                      : ""));
}

} // namespace onde
