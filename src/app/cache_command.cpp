#include "app/cache_command.h"

#include "app/load_request.h"
#include "app/prewarm.h"
#include "gpu/program.h"
#include "scene/load.h"

#include <fmt/format.h>

#include <memory>

namespace onde::app {
namespace {

std::string folder_name(const gpu::ProgramCache& cache) {
    return cache.folder().empty() ? "nowhere (set ONDE_CACHE_DIR)" : cache.folder().string();
}

void list() {
    const gpu::ProgramCache cache;
    const auto entries = cache.list();
    uint64_t bytes = 0;
    for (const auto& entry : entries) {
        fmt::print("{} {:>10} bytes\n", entry.key, entry.bytes);
        bytes += entry.bytes;
    }
    fmt::print("{} programs, {} bytes, in {}\n", entries.size(), bytes, folder_name(cache));
}

void clear() {
    const gpu::ProgramCache cache;
    fmt::print("{} programs removed from {}\n", cache.clear(), folder_name(cache));
}

void add_prewarm(Command& cache) {
    struct Options {
        std::vector<std::string> scenes;
        std::string device;
        LoadRequest load;
    };
    const auto options = std::make_shared<Options>();
    Command command =
        cache.add_command("prewarm", "Compile the kernels that these scenes need, or common ones");
    command.option("scenes", &options->scenes, fmt::format("Scenes: {}", SCENE_FILES),
                   {.value = "SCENE"});
    command.option("--device", &options->device, "Device by number or part of its name");
    declare_load(command, options->load);
    command.on_run(
        [options] { prewarm(options->scenes, options->device, load_options(options->load)); });
}

} // namespace

void add_cache_command(Command& root) {
    Command cache = root.add_command("cache", "The compiled kernels kept on disk");
    cache.require_command();
    cache.add_command("list", "List the entries, their sizes and the folder").on_run(list);
    cache.add_command("clear", "Remove all entries").on_run(clear);
    add_prewarm(cache);
}

} // namespace onde::app
