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
    command.option("--load-limit", &r.gibibytes,
                   "The most memory that loading may take (a quarter of the machine's)",
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

LoadOptions load_options(const LoadRequest& request) {
    LoadOptions options = request.options;
    if (const auto gibibytes = request.gibibytes) {
        if (!(*gibibytes >= 1e-3 && *gibibytes <= 1e6))
            throw InputError("--load-limit {} is out of range; use 0.001 to 1000000 GiB",
                             *gibibytes);
        options.limit = uint64_t(*gibibytes * double(1 << 30));
    }
    if (options.at && !std::isfinite(*options.at))
        throw InputError("--at {} is not a number of seconds", *options.at);
    std::error_code error;
    if (!options.root.empty() && !std::filesystem::is_directory(options.root, error))
        throw InputError("--root {} is not a folder; name one that holds the scene",
                         options.root.string());
    return options;
}

} // namespace onde::app
