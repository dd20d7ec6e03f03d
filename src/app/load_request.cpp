#include "app/load_request.h"

#include "core/error.h"

#include <cmath>

namespace onde::app {

void declare_load(Command& command, LoadRequest& r) {
    command.flag("--strict", r.options.strict,
                 "Refuse a scene with errors that could be repaired or left out");
    command.option("--root", &r.options.root,
                   "Folder that a scene's references may not leave (the scene's own)",
                   {.value = "DIR"});
    command.option("--load-limit", &r.limit,
                   "The most memory that loading may take (a quarter of the machine's)",
                   {.value = "GIB"});
    command.choice("--texture-filter", r.options.texture_filter,
                   "Between texels of all textures; mip, for less noise of what is far away, takes "
                   "coarser ones where many lie in a pixel (each one's own, else linear)");
    command.option("--texture-memory", &r.texture_memory,
                   "The most memory that textures take on the device: the largest are halved until "
                   "all fit (any)",
                   {.value = "GIB"});
    command.option("--at", &r.options.at,
                   "Second of the scene's animation (a glTF file's rest pose; 0 of others)",
                   {.value = "SECONDS"});
    command.option("--animation", &r.options.animation,
                   "Animation of a glTF file, by name or number (all that get along)");
    command.option("--scene", &r.options.scene,
                   "Scene of a glTF file, by name or number (its default)");
    command.option("--variant", &r.options.variant,
                   "Material variant of a glTF file, by name or number (none)");
}

static uint64_t bytes_of(const char* option, double gibibytes) {
    if (!(gibibytes >= 1e-3 && gibibytes <= 1e6))
        throw InputError("{} {} is out of range; use 0.001 to 1000000 GiB", option, gibibytes);
    return uint64_t(gibibytes * double(1 << 30));
}

LoadOptions load_options(const LoadRequest& request) {
    LoadOptions options = request.options;
    if (request.limit) options.limit = bytes_of("--load-limit", *request.limit);
    if (request.texture_memory)
        options.texture_memory = bytes_of("--texture-memory", *request.texture_memory);
    if (options.at && !std::isfinite(*options.at))
        throw InputError("--at {} is not a number of seconds", *options.at);
    std::error_code error;
    if (!options.root.empty() && !std::filesystem::is_directory(options.root, error))
        throw InputError("--root {} is not a folder; name one that holds the scene",
                         options.root.string());
    return options;
}

} // namespace onde::app
