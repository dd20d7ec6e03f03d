#include "image/cryptomatte.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cstring>

namespace onde {
namespace {

uint32_t scramble(uint32_t k) {
    return std::rotl(k * 0xcc9e2d51u, 15) * 0x1b873593u;
}

/// What a pixel shows, the largest share first; equal ones by their ids, whatever order they had.
std::vector<NamedCount> ranked(std::vector<NamedCount> counts, std::span<const uint32_t> ids) {
    std::ranges::sort(counts, [&](const NamedCount& a, const NamedCount& b) {
        return a.count != b.count ? a.count > b.count : ids[a.name] < ids[b.name];
    });
    counts.resize(std::min(counts.size(), MOST_RANKS));
    return counts;
}

std::vector<uint32_t> ids_of(const NamedCounts& counts) {
    std::vector<uint32_t> ids;
    for (const std::string& name : counts.names) ids.push_back(cryptomatte_id(name));
    return ids;
}

float share(uint32_t count, uint32_t samples) {
    return samples > 0 ? float(double(count) / samples) : 0.0f;
}

} // namespace

uint32_t murmur_hash(std::string_view text) {
    uint32_t hash = 0;
    size_t at = 0;
    for (; at + 4 <= text.size(); at += 4) {
        uint32_t word;
        std::memcpy(&word, text.data() + at, 4);
        hash = std::rotl(hash ^ scramble(word), 13) * 5 + 0xe6546b64u;
    }
    uint32_t rest = 0;
    for (size_t i = text.size(); i-- > at;) rest = rest << 8 | uint8_t(text[i]);
    hash ^= scramble(rest) ^ uint32_t(text.size());
    hash = (hash ^ hash >> 16) * 0x85ebca6bu;
    hash = (hash ^ hash >> 13) * 0xc2b2ae35u;
    return hash ^ hash >> 16;
}

uint32_t cryptomatte_id(std::string_view name) {
    const uint32_t hash = murmur_hash(name), exponent = hash >> 23 & 255;
    return exponent == 0 || exponent == 255 ? hash ^ 1u << 23 : hash;
}

std::vector<ExrLayer> cryptomatte_layers(const NamedCounts& counts, const std::string& name) {
    size_t most = 0;
    for (const auto& pixel : counts.pixels) most = std::max(most, pixel.size());
    const size_t layers = (std::clamp<size_t>(most, 1, MOST_RANKS) + 1) / 2;
    const std::vector<uint32_t> ids = ids_of(counts);
    std::vector<ExrLayer> all;
    for (size_t layer = 0; layer < layers; layer++) {
        std::vector<std::string> names;
        for (const char letter : {'R', 'G', 'B', 'A'})
            names.push_back(fmt::format("{}{:02}.{}", name, layer, letter));
        all.push_back({Image(counts.width, counts.height, 4), names, ExrDepth::full_float});
    }
    for (size_t i = 0; i < counts.pixels.size(); i++) {
        const std::vector<NamedCount> ranks = ranked(counts.pixels[i], ids);
        for (size_t rank = 0; rank < ranks.size(); rank++) {
            float* pair = &all[rank / 2].image.pixels[4 * i + 2 * (rank % 2)];
            pair[0] = std::bit_cast<float>(ids[ranks[rank].name]);
            pair[1] = share(ranks[rank].count, counts.samples[i]);
        }
    }
    return all;
}

ImageMetadata cryptomatte_metadata(const NamedCounts& counts, const std::string& name) {
    nlohmann::ordered_json manifest = nlohmann::ordered_json::object();
    for (const std::string& thing : counts.names)
        manifest[thing] = fmt::format("{:08x}", cryptomatte_id(thing));
    const std::string key =
        "cryptomatte/" + fmt::format("{:08x}", murmur_hash(name)).substr(0, 7) + "/";
    return {{key + "name", name},
            {key + "hash", "MurmurHash3_32"},
            {key + "conversion", "uint32_to_float32"},
            {key + "manifest",
             manifest.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)}};
}

Image cryptomatte_preview(const NamedCounts& counts) {
    const std::vector<uint32_t> ids = ids_of(counts);
    Image image(counts.width, counts.height, 3);
    for (size_t i = 0; i < counts.pixels.size(); i++)
        for (const NamedCount& count : counts.pixels[i])
            for (uint32_t k = 0; k < 3; k++)
                image.pixels[3 * i + k] += share(count.count, counts.samples[i]) *
                                           float(ids[count.name] >> 8 * k & 255) / 255.0f;
    return image;
}

} // namespace onde
