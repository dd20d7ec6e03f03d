#include "front.h"

#include "core/error.h"
#include "core/log.h"

namespace onde::bench {

int run_main(CommandLine& line, int argc, char** argv, const std::function<void()>& run) {
    set_up_logging(false);
    const auto fail = [](int code, const std::string& sentence) {
        spdlog::error(sentence);
        return code;
    };
    try {
        if (line.run(argc, argv)) run();
        return 0;
    } catch (const InputError& error) {
        return fail(2, error.what());
    } catch (const DeviceError& error) {
        return fail(3, error.what());
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

void add_repetitions(Command& command, uint32_t& repetitions) {
    command.option("--repetitions", &repetitions, "timed runs of each contender",
                   {.show_default = true, .least = 1, .most = 1000});
}

void add_device(Command& command, std::string& device) {
    command.option("--device", &device, "OpenCL device, as for onde");
}

void add_kernels(Command& command, std::string& folder) {
    command.option("--kernels", &folder, "read kernels from this folder");
}

void add_json(Command& command, std::string& path) {
    command.option("--json", &path, "also write the figures to this file");
}

} // namespace onde::bench
