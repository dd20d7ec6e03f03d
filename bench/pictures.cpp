#include "pictures.h"

namespace onde::bench {

void add_pictures(Command& command, PictureOptions& options) {
    command.option("scenes", &options.scenes, "Scene files", {.value = "SCENE", .required = true});
    command.option("--environment", &options.environment, "Light them all with this map",
                   {.value = "FILE"});
    command.option("--width", &options.width, "of the pictures",
                   {.show_default = true, .least = 1, .most = 16384});
    command.option("--height", &options.height, "of the pictures",
                   {.show_default = true, .least = 1, .most = 16384});
}

LoadOptions load_options(const PictureOptions& options) {
    LoadOptions load;
    load.size = glm::uvec2(options.width, options.height);
    if (!options.environment.empty())
        load.environment = load_environment(options.environment, glm::vec3(1.0f), 0);
    return load;
}

} // namespace onde::bench
