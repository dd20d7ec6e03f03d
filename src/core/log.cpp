#include "core/log.h"

#include <spdlog/sinks/stdout_sinks.h>

namespace onde {

void set_up_logging(bool quiet) {
    auto logger =
        std::make_shared<spdlog::logger>("onde", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    logger->set_pattern("onde: %v");
    logger->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace onde
