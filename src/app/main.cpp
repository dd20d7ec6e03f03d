// The front door of the command line: one subcommand per file, errors turned into exit codes here.
#include "app/cache_command.h"
#include "app/compare_command.h"
#include "app/devices_command.h"
#include "app/doctor_command.h"
#include "app/farm_command.h"
#include "app/film_command.h"
#include "app/gallery_command.h"
#include "app/info_command.h"
#include "app/inspect_command.h"
#include "app/interrupt.h"
#include "app/merge_command.h"
#include "app/reference_command.h"
#include "app/render_command.h"
#include "app/thumbnail_command.h"
#include "app/volumes_command.h"
#include "app/work_command.h"

#include "core/error.h"
#include "core/log.h"
#include "core/stack.h"
#include "core/text.h"

#include <csignal>
#include <cstdio>
#include <new>

namespace {

enum ExitCode { SUCCESS = 0, CHECK_FAILED = 1, WRONG_INPUT = 2, NO_DEVICE = 3 };

int fail(ExitCode code, const char* sentence) {
    std::fprintf(stderr, "onde: %s\n", onde::printable_lines(sentence).c_str());
    return code;
}

int run(int argc, char** argv) try {
    std::signal(SIGXFSZ, SIG_IGN); // a file that may not grow is an error where it is written
    onde::set_up_logging(false);
    onde::CommandLine line("onde",
                           "Onde renders scenes on any OpenCL device.\n"
                           "Try: onde render scenes/chapter/five-objects.toml",
                           ONDE_VERSION);
    onde::Command root = line.root();
    root.require_command();
    bool interrupted = false, unfit = false;
    onde::app::add_render_command(root, interrupted);
    onde::app::add_merge_command(root, interrupted);
    onde::app::add_work_command(root, interrupted);
    onde::app::add_farm_command(root);
    onde::app::add_film_command(root);
    onde::app::add_info_command(root);
    onde::app::add_reference_command(root);
    onde::app::add_inspect_command(root);
    onde::app::add_volumes_command(root);
    onde::app::add_gallery_command(root, interrupted);
    onde::app::add_thumbnail_command(root, interrupted);
    onde::app::add_compare_command(root);
    onde::app::add_devices_command(root);
    onde::app::add_doctor_command(root, unfit, interrupted);
    onde::app::add_cache_command(root);
    line.run(argc, argv);
    if (std::fflush(stdout) != 0) // a full disk behind it, for example
        return fail(WRONG_INPUT, "standard output could not be written");
    if (interrupted) return onde::app::StopOnInterrupt::exit_code();
    return unfit ? CHECK_FAILED : SUCCESS;
} catch (const onde::InputError& error) {
    return fail(WRONG_INPUT, error.what());
} catch (const onde::DeviceError& error) {
    return fail(NO_DEVICE, error.what());
} catch (const std::bad_alloc&) {
    return fail(WRONG_INPUT, "out of memory; use a smaller scene or picture");
} catch (const std::exception& error) {
    return fail(WRONG_INPUT, error.what());
}

} // namespace

int main(int argc, char** argv) {
    int code = SUCCESS;
    onde::with_enough_stack([&] { code = run(argc, argv); });
    return code;
}
