#include "front.h"

#include "core/error.h"
#include "core/log.h"

namespace onde::bench {

int run_main(CLI::App& app, int argc, char** argv, const std::function<void()>& run) {
    set_up_logging(false);
    const auto fail = [](int code, const std::string& sentence) {
        spdlog::error(sentence);
        return code;
    };
    try {
        app.parse(argc, argv);
        run();
        return 0;
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help
        return fail(2, std::string(error.what()) + "; --help lists the options");
    } catch (const InputError& error) {
        return fail(2, error.what());
    } catch (const DeviceError& error) {
        return fail(3, error.what());
    } catch (const std::exception& error) {
        return fail(1, error.what());
    }
}

void add_repetitions(CLI::App& app, uint32_t& repetitions) {
    app.add_option("--repetitions", repetitions, "timed runs of each contender")
        ->check(CLI::Range(1, 1000))
        ->capture_default_str();
}

void add_json(CLI::App& app, std::string& path) {
    app.add_option("--json", path, "also write the figures to this file");
}

} // namespace onde::bench
