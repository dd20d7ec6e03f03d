// `onde devices`: what OpenCL offers on this machine.
#pragma once

namespace CLI {
class App;
}

namespace onde::app {

/// Adds the subcommand, which prints every platform and device, broken ones with their reason, and
/// marks the one that a render takes by default; as JSON with --json.
void add_devices_command(CLI::App& app);

} // namespace onde::app
