// WebP by libwebp: still pictures.
#include "image/stored_image.h"

#include <webp/decode.h>

namespace onde {
namespace {

WebPBitstreamFeatures features(FileBytes file) {
    WebPBitstreamFeatures found;
    if (WebPGetFeatures(file.data(), file.size(), &found) != VP8_STATUS_OK)
        throw ImageProblem("its header is damaged");
    if (found.has_animation) throw ImageProblem("it is an animation");
    return found;
}

ImageHeader header(FileBytes file) {
    const WebPBitstreamFeatures found = features(file);
    ImageHeader size{uint32_t(found.width), uint32_t(found.height), found.has_alpha ? 4u : 3u};
    size.least_bytes = least_bytes_of_any(size.samples());
    return size;
}

StoredImage decode(FileBytes file) {
    const ImageHeader size = header(file);
    auto samples = samples_of<uint8_t>(size.pixels(), size.channels);
    const auto read = size.channels == 4 ? WebPDecodeRGBAInto : WebPDecodeRGBInto;
    if (!read(file.data(), file.size(), samples.data(), samples.size(),
              int(size.width * size.channels)))
        throw ImageProblem("it is damaged or ends early");
    return {size.width, size.height, size.channels, std::move(samples)};
}

bool recognise(FileBytes file) {
    const std::string_view text = as_text(file);
    return text.starts_with("RIFF") && text.size() >= 12 && text.substr(8, 4) == "WEBP";
}

} // namespace

const ImageFormat WEBP_FORMAT{"WebP", recognise, header, decode, nullptr};

} // namespace onde
