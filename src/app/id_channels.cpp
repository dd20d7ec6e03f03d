#include "app/id_channels.h"

#include <algorithm>
#include <map>

namespace onde::app {
namespace {

/// Numbers for names, each once, in the order in which they come.
class NameList {
  public:
    uint32_t number(const std::string& name) {
        const auto [found, is_new] = numbers_.try_emplace(name, uint32_t(names.size()));
        if (is_new) names.push_back(name);
        return found->second;
    }
    std::vector<std::string> names{};

  private:
    std::map<std::string, uint32_t> numbers_{};
};

/// Which member of an id a channel tells, and what its values are called; without names each value
/// is a thing of its own.
struct Key {
    uint32_t SeenId::*member;
    const std::vector<std::string>* names;
};

Key key_of(IdChannel channel, const IdNames& names) {
    switch (channel) {
    case IdChannel::crypto_object:
    case IdChannel::object_id:
        return {&SeenId::object, &names.objects};
    case IdChannel::crypto_asset:
        return {&SeenId::object, &names.assets};
    case IdChannel::crypto_material:
    case IdChannel::material_id:
        return {&SeenId::material, &names.materials};
    case IdChannel::instance_id:
        break;
    }
    return {&SeenId::object, nullptr};
}

/// Joins what has the same name, and leaves out where there is nothing.
NamedCounts named_counts(const SeenThings& things, const Key& key) {
    NamedCounts named{things.width, things.height};
    NameList list;
    std::vector<uint32_t> number; ///< by value
    if (key.names)
        for (const std::string& name : *key.names) number.push_back(list.number(name));
    for (const PixelIds& ids : things.counts) {
        std::vector<NamedCount>& pixel = named.pixels.emplace_back();
        uint32_t& samples = named.samples.emplace_back();
        for (const IdCount& seen : ids) {
            samples += seen.count;
            if (seen.id == NOTHING_SEEN) continue;
            const uint32_t value = seen.id.*key.member;
            const uint32_t name = key.names ? number[value] : value;
            const auto known = std::ranges::find(pixel, name, &NamedCount::name);
            if (known == pixel.end())
                pixel.push_back({name, seen.count});
            else
                known->count += seen.count;
        }
    }
    named.names = std::move(list.names);
    return named;
}

/// From 1, of what most samples of a pixel see; 0 where that is nothing. Of equals the first.
Image numbers_of(const NamedCounts& counts) {
    Image image(counts.width, counts.height, 1);
    for (size_t i = 0; i < counts.pixels.size(); i++) {
        uint32_t most = counts.samples[i], first = 0;
        for (const NamedCount& seen : counts.pixels[i]) most -= seen.count; // of nothing
        for (const NamedCount& seen : counts.pixels[i]) {
            const bool is_before = seen.count == most && first > 0 && seen.name + 1 < first;
            if (seen.count <= most && !is_before) continue;
            most = seen.count;
            first = seen.name + 1;
        }
        image.pixels[i] = float(first);
    }
    return image;
}

/// As cryptomatte_preview() has it, of things without names.
Image shown_numbers(const Image& numbers) {
    Image shown(numbers.width, numbers.height, 3);
    for (size_t i = 0; i < numbers.pixels.size(); i++) {
        if (!(numbers.pixels[i] > 0)) continue;
        const uint32_t bits = cryptomatte_id(std::to_string(uint32_t(numbers.pixels[i])));
        for (uint32_t k = 0; k < 3; k++)
            shown.pixels[3 * i + k] = float(bits >> 8 * k & 255) / 255.0f;
    }
    return shown;
}

/// "CryptoObject", as others call theirs.
const char* layer_of(IdChannel channel) {
    if (channel == IdChannel::crypto_object) return "CryptoObject";
    return channel == IdChannel::crypto_material ? "CryptoMaterial" : "CryptoAsset";
}

} // namespace

IdLayers id_layers(IdChannel channel, const SeenThings& things, const std::string& prefix,
                   const std::string& number) {
    const NamedCounts counts = named_counts(things, key_of(channel, things.names));
    if (channel <= IdChannel::crypto_asset) {
        const std::string name = prefix + layer_of(channel);
        return {cryptomatte_layers(counts, name), cryptomatte_metadata(counts, name),
                cryptomatte_preview(counts)};
    }
    Image numbers = numbers_of(counts);
    Image shown = shown_numbers(numbers);
    return {{{std::move(numbers), {number}, ExrDepth::whole_number}}, {}, std::move(shown)};
}

} // namespace onde::app
