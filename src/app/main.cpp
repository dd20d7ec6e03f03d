// The front door of the command line: one subcommand per file, errors turned into exit codes here.
#include "app/cache_command.h"
#include "app/compare_command.h"
#include "app/devices_command.h"
#include "app/gallery_command.h"
#include "app/info_command.h"
#include "app/inspect_command.h"
#include "app/render_command.h"
#include "app/usage_error.h"
#include "app/volumes_command.h"

#include "core/error.h"
#include "core/log.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <new>

namespace {

enum ExitCode { SUCCESS = 0, WRONG_INPUT = 2, NO_DEVICE = 3, INTERRUPTED = 130 };

int fail(ExitCode code, const char* sentence) {
    std::fprintf(stderr, "onde: %s\n", sentence);
    return code;
}

} // namespace

int main(int argc, char** argv) try {
    onde::set_up_logging(false);
    CLI::App app{"Onde renders scenes on any OpenCL device.\n"
                 "Try: onde render scenes/chapter/five-objects.toml",
                 "onde"};
    app.require_subcommand(1);
    app.set_version_flag("--version", ONDE_VERSION);
    bool interrupted = false;
    onde::app::add_render_command(app, interrupted);
    onde::app::add_info_command(app);
    onde::app::add_inspect_command(app);
    onde::app::add_volumes_command(app);
    onde::app::add_gallery_command(app, interrupted);
    onde::app::add_compare_command(app);
    onde::app::add_devices_command(app);
    onde::app::add_cache_command(app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
        return fail(WRONG_INPUT, onde::app::usage_sentence(app, error).c_str());
    }
    if (std::fflush(stdout) != 0) // a full disk behind it, for example
        return fail(WRONG_INPUT, "standard output could not be written");
    return interrupted ? INTERRUPTED : SUCCESS;
} catch (const onde::InputError& error) {
    return fail(WRONG_INPUT, error.what());
} catch (const onde::DeviceError& error) {
    return fail(NO_DEVICE, error.what());
} catch (const std::bad_alloc&) {
    return fail(WRONG_INPUT, "out of memory; use a smaller scene or picture");
} catch (const std::exception& error) {
    return fail(WRONG_INPUT, error.what());
}
