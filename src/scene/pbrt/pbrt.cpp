// pbrt-v4's scene files: pbrt.org/fileformat-v4.
#include "scene/loaders.h"
#include "scene/pbrt/reader.h"

namespace onde {

Scene load_pbrt(const std::filesystem::path& path, LoadContext& context) {
    const std::optional<double> at = context.options().at;
    pbrt::Reader reader(path, context, at.value_or(0.0));
    Scene scene = reader.read();
    const std::optional<double> opening = reader.opening();
    // What moves is as the shutter opens, which the file may say after it.
    if (opening && !at && *opening != 0.0) scene = pbrt::Reader(path, context, *opening).read();
    return scene;
}

std::vector<FileWord> pbrt::directive_words() {
    return Reader::directive_words();
}

} // namespace onde
