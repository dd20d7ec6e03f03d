#include "upload/textures.h"

#include "core/error.h"
#include "core/shown.h"
#include "image/texel_format.h"
#include "upload/words.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <set>

namespace onde {
namespace {

/// Lanes gather by signed indices.
constexpr uint64_t MOST_WORDS = uint64_t(1) << 31;

/// Where pictures lie, before anything is allocated.
class TexelPlaces {
  public:
    explicit TexelPlaces(const TextureOptions& options)
        : room_(std::min(options.largest_buffer / sizeof(uint32_t), MOST_WORDS)) {}

    /// Fills in the record's place.
    void add(const Texture& texture, TextureRecord& record) {
        const TexelImage& image = texture.image;
        record.format = uint32_t(texel_format(image));
        record.words = texel_words(image);
        record.width = image.width;
        record.height = image.height;
        const uint64_t words = uint64_t(image.width) * image.height * record.words;
        const auto has_room = [&](uint64_t used) { return words <= room_ - used; };
        const auto found = std::ranges::find_if(used_, has_room);
        if (found == used_.end())
            throw InputError("the texture {} does not fit into the {} buffers of {} MiB that the "
                             "device allows for textures; lower them by --texture-memory",
                             shown(texture.name), used_.size(), (room_ * sizeof(uint32_t)) >> 20);
        record.buffer = uint32_t(found - used_.begin());
        record.offset = uint32_t(*found);
        *found += words;
    }

    uint64_t words(size_t buffer) const { return used_[buffer]; }

  private:
    uint64_t room_;
    std::array<uint64_t, TEXEL_BUFFER_COUNT> used_{};
};

/// All of a record but the place, size and format of its texels.
TextureRecord texture_record(const Texture& texture, const std::vector<uint32_t>& sets) {
    TextureRecord record{};
    record.wrap_u = uint32_t(texture.wrap_u);
    record.wrap_v = uint32_t(texture.wrap_v);
    record.filter = uint32_t(texture.filter);
    record.uv_set = uint32_t(std::ranges::find(sets, texture.uv_set) - sets.begin());
    const glm::vec2 origin = texture.transform({0, 0});
    const glm::vec2 x = texture.transform({1, 0}) - origin, y = texture.transform({0, 1}) - origin;
    copy(record.u, glm::vec3(x.x, y.x, origin.x));
    copy(record.v, glm::vec3(x.y, y.y, origin.y));
    return record;
}

void share_texels(TextureRecord& record, const TextureRecord& owner) {
    record.offset = owner.offset;
    record.format = owner.format;
    record.words = owner.words;
    record.buffer = owner.buffer;
    record.width = owner.width;
    record.height = owner.height;
}

/// Codes of 8 bits lie as they are; of 16 bits the higher bytes are followed by the lower ones.
void write_codes(const TexelImage& image, uint32_t* words) {
    if (image.low.empty()) {
        std::memcpy(words, image.rgba.data(), image.rgba.size());
        return;
    }
    for (size_t at = 0; at < image.rgba.size(); at += 4, words += 2) {
        std::memcpy(words, &image.rgba[at], 4);
        std::memcpy(words + 1, &image.low[at], 4);
    }
}

void write_halves(const TexelImage& image, uint32_t* words) {
    for (size_t at = 0; at < image.floats.size(); at += 2)
        *words++ = *exact_half(image.floats[at]) |
                   uint32_t(*exact_half(image.floats[at + 1])) << 16;
}

void write_texels(const TexelImage& image, uint32_t format, uint32_t* words) {
    switch (TexelFormat(format)) {
    case TexelFormat::codes:
        return write_codes(image, words);
    case TexelFormat::halves:
        return write_halves(image, words);
    case TexelFormat::floats:
        std::memcpy(words, image.floats.data(), image.floats.size() * sizeof(float));
    }
}

} // namespace

std::vector<uint32_t> used_uv_sets(const Scene& scene) {
    std::set<uint32_t> sets;
    for (const Texture& texture : scene.textures) sets.insert(texture.uv_set);
    if (sets.empty()) sets.insert(0);
    return {sets.begin(), sets.end()};
}

PackedTextures pack_textures(const Scene& scene, const TextureOptions& options) {
    static_assert(uint32_t(TextureFilter::nearest) == FILTER_NEAREST);
    static_assert(uint32_t(TexelFormat::codes) == TEXEL_CODES);
    static_assert(uint32_t(TexelFormat::halves) == TEXEL_HALVES);
    static_assert(uint32_t(TexelFormat::floats) == TEXEL_FLOATS);
    PackedTextures packed;
    TexelPlaces places(options);
    const std::vector<uint32_t> sets = used_uv_sets(scene);
    for (const Texture& texture : scene.textures) {
        TextureRecord& record = packed.records.emplace_back(texture_record(texture, sets));
        if (texture.same_image_as == NO_TEXTURE)
            places.add(texture, record);
        else
            share_texels(record, packed.records[size_t(texture.same_image_as)]);
    }
    for (size_t i = 0; i < packed.texels.size(); i++) packed.texels[i].resize(places.words(i));
    for (size_t i = 0; i < scene.textures.size(); i++) {
        const TextureRecord& record = packed.records[i];
        if (scene.textures[i].same_image_as == NO_TEXTURE)
            write_texels(scene.textures[i].image, record.format,
                         &packed.texels[record.buffer][record.offset]);
    }
    return packed;
}

std::vector<float> srgb_table() {
    std::vector<float> table(256);
    for (int i = 0; i < 256; i++) {
        const double c = i / 255.0;
        table[size_t(i)] = float(c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4));
    }
    return table;
}

} // namespace onde
