#include "upload/textures.h"

#include "core/error.h"
#include "core/shown.h"
#include "image/lowered.h"
#include "image/texel_format.h"
#include "scene/texture_levels.h"
#include "upload/words.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <set>

namespace onde {
namespace {

/// Lanes gather by signed indices.
constexpr uint64_t MOST_WORDS = uint64_t(1) << 31;

/// Where a picture's texels lie.
struct Place {
    uint32_t buffer, offset, width, height;
    TexelFormat format;
};

/// Finds places, before anything is allocated.
class TexelPlaces {
  public:
    explicit TexelPlaces(const TextureOptions& options)
        : room_(std::min(options.largest_buffer / sizeof(uint32_t), MOST_WORDS)) {}

    Place add(const TexelImage& image, const std::string& name) {
        const uint64_t words = device_bytes(image) / sizeof(uint32_t);
        const auto has_room = [&](uint64_t used) { return words <= room_ - used; };
        const auto found = std::ranges::find_if(used_, has_room);
        if (found == used_.end())
            throw InputError("the texture {} does not fit into the {} buffers of {} MiB that the "
                             "device allows for textures; lower them by --texture-memory",
                             shown(name), used_.size(), (room_ * sizeof(uint32_t)) >> 20);
        const auto offset = uint32_t(*found);
        *found += words;
        return {uint32_t(found - used_.begin()), offset, image.width, image.height,
                texel_format(image)};
    }

    uint64_t words(size_t buffer) const { return used_[buffer]; }

  private:
    uint64_t room_;
    std::array<uint64_t, TEXEL_BUFFER_COUNT> used_{};
};

/// Of a picture: itself, and its coarser levels where a texture asks for them.
struct Levels {
    std::vector<TexelImage> coarser;
    std::vector<Place> places; ///< of the picture, then of those
};

/// Each half as wide and high as the one before.
std::vector<TexelImage> coarser_levels(const TexelImage& image, bool srgb) {
    std::vector<TexelImage> levels;
    for (const TexelImage* last = &image; std::max(last->width, last->height) > 1;
         last = &levels.back())
        levels.push_back(
            lowered(*last, coarser_side(last->width), coarser_side(last->height), srgb));
    return levels;
}

/// All of a record but the place, size and format of its texels.
TextureRecord texture_record(const Texture& texture, const std::vector<uint32_t>& sets) {
    TextureRecord record{};
    record.wrap_u = uint32_t(texture.wrap_u);
    record.wrap_v = uint32_t(texture.wrap_v);
    record.coarser = NO_INDEX;
    record.filter = uint32_t(texture.filter);
    record.uv_set = uint32_t(std::ranges::find(sets, texture.uv_set) - sets.begin());
    const glm::vec2 origin = texture.transform({0, 0});
    const glm::vec2 x = texture.transform({1, 0}) - origin, y = texture.transform({0, 1}) - origin;
    copy(record.u, glm::vec3(x.x, y.x, origin.x));
    copy(record.v, glm::vec3(x.y, y.y, origin.y));
    return record;
}

void put(TextureRecord& record, const Place& place) {
    record.buffer = place.buffer;
    record.offset = place.offset;
    record.width = place.width;
    record.height = place.height;
    record.format = uint32_t(place.format);
}

void write_wide(const TexelImage& image, uint32_t* words) {
    for (size_t at = 0; at < image.rgba.size(); at += 4, words += 2) {
        std::memcpy(words, &image.rgba[at], 4);
        std::memcpy(words + 1, &image.low[at], 4);
    }
}

void write_halves(const TexelImage& image, uint32_t* words) {
    for (size_t at = 0; at < image.floats.size(); at += 2)
        *words++ = *exact_half(image.floats[at]) | uint32_t(*exact_half(image.floats[at + 1]))
                                                       << 16;
}

void write_texels(const TexelImage& image, TexelFormat format, uint32_t* words) {
    switch (format) {
    case TexelFormat::bytes:
        std::memcpy(words, image.rgba.data(), image.rgba.size());
        break;
    case TexelFormat::wide:
        return write_wide(image, words);
    case TexelFormat::halves:
        return write_halves(image, words);
    case TexelFormat::floats:
        std::memcpy(words, image.floats.data(), image.floats.size() * sizeof(float));
    }
}

/// The texture whose picture another one shows: itself, or an earlier one.
size_t owner_of(const Scene& scene, size_t texture) {
    const int32_t same = scene.textures[texture].same_image_as;
    return same == NO_TEXTURE ? texture : size_t(same);
}

/// By texture; of those that own their picture.
std::vector<Levels> make_levels(const Scene& scene, TexelPlaces& places) {
    const std::vector<bool> with_levels = pictures_with_levels(scene);
    std::vector<Levels> all(scene.textures.size());
    for (size_t i = 0; i < scene.textures.size(); i++) {
        const Texture& texture = scene.textures[i];
        if (owner_of(scene, i) != i) continue;
        if (with_levels[i]) all[i].coarser = coarser_levels(texture.image, texture.srgb);
        all[i].places.push_back(places.add(texture.image, texture.name));
        for (const TexelImage& level : all[i].coarser)
            all[i].places.push_back(places.add(level, texture.name));
    }
    return all;
}

/// One for each texture, behind them those of coarser levels.
std::vector<TextureRecord> make_records(const Scene& scene, const std::vector<Levels>& levels) {
    const std::vector<uint32_t> sets = used_uv_sets(scene);
    std::vector<TextureRecord> records;
    for (size_t i = 0; i < scene.textures.size(); i++) {
        records.push_back(texture_record(scene.textures[i], sets));
        put(records.back(), levels[owner_of(scene, i)].places[0]);
    }
    for (size_t i = 0; i < scene.textures.size(); i++) {
        const std::vector<Place>& places = levels[owner_of(scene, i)].places;
        if (scene.textures[i].filter != TextureFilter::mip || places.size() == 1) continue;
        records[i].coarser = uint32_t(records.size());
        for (size_t level = 1; level < places.size(); level++) {
            TextureRecord record = records[i];
            put(record, places[level]);
            records.push_back(record);
        }
    }
    return records;
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
    static_assert(uint32_t(TextureFilter::mip) == FILTER_MIP);
    static_assert(uint32_t(TexelFormat::bytes) == TEXEL_BYTES);
    static_assert(uint32_t(TexelFormat::wide) == TEXEL_WIDE);
    static_assert(uint32_t(TexelFormat::halves) == TEXEL_HALVES);
    static_assert(uint32_t(TexelFormat::floats) == TEXEL_FLOATS);
    PackedTextures packed;
    TexelPlaces places(options);
    const std::vector<Levels> levels = make_levels(scene, places);
    packed.records = make_records(scene, levels);
    for (size_t i = 0; i < packed.texels.size(); i++) packed.texels[i].resize(places.words(i));
    const auto write = [&](const TexelImage& image, const Place& place) {
        write_texels(image, place.format, &packed.texels[place.buffer][place.offset]);
    };
    for (size_t i = 0; i < levels.size(); i++) {
        if (levels[i].places.empty()) continue;
        write(scene.textures[i].image, levels[i].places[0]);
        for (size_t level = 0; level < levels[i].coarser.size(); level++)
            write(levels[i].coarser[level], levels[i].places[level + 1]);
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
