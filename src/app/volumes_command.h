// `onde volumes SCENE`: the bounding-volume laboratory (C12, C13).
#pragma once

namespace CLI {
class App;
}

namespace onde::app {

void add_volumes_command(CLI::App& app);

} // namespace onde::app
