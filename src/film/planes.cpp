#include "film/planes.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

constexpr uint32_t COUNT = 3; ///< the component that counts a plane's samples

/// A plane is called as the first channel that reads it.
struct Plane {
    std::string name;
    uint32_t sums, components;
};

/// Those of a film with these AOVs.
std::vector<Plane> planes_of(uint32_t aovs) {
    std::vector<Plane> planes;
    for (const FilmChannel& channel : FILM_CHANNELS) {
        if (channel.sums != RADIANCE_SUMS && !(aovs >> channel.sums & 1)) continue;
        auto plane = std::ranges::find(planes, channel.sums, &Plane::sums);
        if (plane == planes.end())
            plane = planes.insert(planes.end(), {std::string(channel.name), channel.sums, 0});
        if (channel.first < COUNT)
            plane->components = std::max(plane->components, channel.first + channel.components());
    }
    return planes;
}

/// As viewers of pictures know them: one number is grey, three are a colour.
std::string component_name(uint32_t component, uint32_t components) {
    if (component == COUNT) return "samples";
    return components == 1 ? "Y" : std::string(1, "RGB"[component]);
}

} // namespace

std::string group_layer(const std::string& group) {
    return std::string(GROUP_PREFIX) + group;
}

std::string aov_words_of(uint32_t aovs) {
    std::string words;
    for (const Plane& plane : planes_of(aovs))
        if (plane.sums != RADIANCE_SUMS) words += (words.empty() ? "" : ",") + plane.name;
    return words;
}

std::optional<uint32_t> aovs_of(const std::string& words) {
    uint32_t aovs = 0;
    for (size_t begin = 0; begin < words.size();) {
        const size_t end = std::min(words.find(',', begin), words.size());
        const FilmChannel* channel = find_channel(words.substr(begin, end - begin));
        if (!channel || channel->sums == RADIANCE_SUMS) return std::nullopt;
        aovs |= 1u << channel->sums;
        begin = end + 1;
    }
    return aovs;
}

PlaneChannels::PlaneChannels(uint32_t aovs, const std::vector<std::string>& groups) {
    const FilmPlanes film{aovs, uint32_t(groups.size())};
    planes_ = film.count();
    std::vector<Plane> planes = planes_of(aovs);
    for (const std::string& group : groups)
        planes.push_back({group_layer(group), GROUP_SUMS + uint32_t(&group - groups.data()), 3});
    for (const Plane& plane : planes) {
        std::vector<uint32_t> components{COUNT};
        for (uint32_t k = 0; k < plane.components; k++) components.push_back(k);
        for (const uint32_t k : components)
            places_.push_back({{plane.name + "." + component_name(k, plane.components), k != COUNT},
                               film.plane(plane.sums),
                               k});
    }
    std::ranges::sort(places_, {}, [](const Place& place) { return place.channel.name; });
}

std::vector<ExrChannel> PlaneChannels::channels() const {
    std::vector<ExrChannel> channels;
    for (const Place& place : places_) channels.push_back(place.channel);
    return channels;
}

void PlaneChannels::pack(std::span<const cl_float4> sums, size_t width,
                         std::span<uint32_t> words) const {
    auto word = words.begin();
    for (const Place& place : places_)
        for (size_t x = 0; x < width; x++) {
            const float value = sums[place.plane * width + x].s[place.component];
            *word++ = place.component == COUNT ? uint32_t(std::clamp(value, 0.0f, 4294967040.0f))
                                               : std::bit_cast<uint32_t>(value);
        }
}

void PlaneChannels::unpack(std::span<const uint32_t> words, size_t width,
                           std::span<cl_float4> sums) const {
    auto word = words.begin();
    for (const Place& place : places_)
        for (size_t x = 0; x < width; x++, ++word)
            sums[place.plane * width + x].s[place.component] =
                place.component == COUNT ? float(*word) : std::bit_cast<float>(*word);
}

} // namespace onde
