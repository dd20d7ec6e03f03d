// How the planes of a film (render/film_contents.h) are called in files, read off the list of its
// channels: what that list gains, files have.
#pragma once

#include "image/exr_rows.h"
#include "render/film_contents.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// What the light of a group of lights is called.
inline constexpr std::string_view GROUP_PREFIX = "group.";
std::string group_layer(const std::string& group);

/// The AOVs of a film by name, as "albedo,normal", and back; nothing where a name is none.
std::string aov_words_of(uint32_t aovs);
std::optional<uint32_t> aovs_of(const std::string& words);

/// The channels of a row in a file, and where each is in the sums of the row: plane after plane of
/// float4. In the order of their names, as files have them.
class PlaneChannels {
  public:
    PlaneChannels(uint32_t aovs, const std::vector<std::string>& groups);

    std::vector<ExrChannel> channels() const;
    uint32_t planes() const { return planes_; }
    size_t count() const { return places_.size(); }

    /// Sums of a row of so many pixels into words, channel after channel, and back. Sample counts
    /// are whole numbers in files.
    void pack(std::span<const cl_float4> sums, size_t width, std::span<uint32_t> words) const;
    void unpack(std::span<const uint32_t> words, size_t width, std::span<cl_float4> sums) const;

  private:
    struct Place {
        ExrChannel channel;
        uint32_t plane, component;
    };
    std::vector<Place> places_;
    uint32_t planes_;
};

} // namespace onde
