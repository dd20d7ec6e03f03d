// pbrt-v4's scene files: pbrt.org/fileformat-v4.
#include "scene/loaders.h"
#include "scene/pbrt/reader.h"

namespace onde {

Scene load_pbrt(const std::filesystem::path& path, LoadContext& context) {
    return pbrt::Reader(path, context).read();
}

std::vector<FileWord> pbrt::directive_words() {
    return Reader::directive_words();
}

} // namespace onde
