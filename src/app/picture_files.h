// The files of a picture: an .exr holds the picture and every channel that is asked for, beside a
// .png each of them has a file of its own.
#pragma once

#include "app/picture.h"

#include "film/merge.h"

#include <string_view>

namespace onde::app {

/// The name of each component of a channel: "R", "albedo.R" and "depth.Z", or
/// "ViewLayer.Combined.R", "ViewLayer.Albedo.R" and "ViewLayer.Depth.Z". letters: one for each.
std::vector<std::string> exr_names(std::string_view channel, std::string_view letters,
                                   ExrNames names);

/// A channel as an .exr has it: light in that depth, other numbers as floats.
ExrLayer exr_layer(std::string_view channel, std::string_view letters, const Image& numbers,
                   ExrDepth depth_of_light, ExrNames names);

/// What an .exr holds.
struct ExrContents {
    std::vector<ExrLayer> layers;
    ImageMetadata metadata;
};

/// The picture of a film, and every AOV that it has; metadata: beside what its AOVs need.
ExrContents film_contents(FilmMerge& film, const Image& picture, ImageMetadata metadata,
                          bool full_float, ExrNames names);

/// Logs it, but for standard output.
void tell_written(const std::filesystem::path& path);

/// Writes what the session shows to each path, and says so.
void write_picture_files(const std::vector<std::filesystem::path>& paths, Outputs& outputs,
                         Session& session, const RenderRequest& request, const ShownPicture& shown,
                         const ImageMetadata& metadata);

} // namespace onde::app
