// `onde inspect SCENE --pixel X,Y`: what happened to one sample of one pixel.
#pragma once

namespace CLI {
class App;
}

namespace onde::app {

/// Adds the subcommand; it prints to standard output. Throws InputError and DeviceError.
void add_inspect_command(CLI::App& app);

} // namespace onde::app
