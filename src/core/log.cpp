#include "core/log.h"

#include "core/text.h"

#include <spdlog/pattern_formatter.h>
#include <spdlog/sinks/stdout_sinks.h>

namespace onde {

namespace {

/// The message as `printable` shows it: it may hold names that others chose.
class PrintableMessage : public spdlog::custom_flag_formatter {
  public:
    void format(const spdlog::details::log_msg& message, const std::tm&,
                spdlog::memory_buf_t& to) override {
        const std::string_view payload(message.payload.data(), message.payload.size());
        const std::string line = printable(payload, std::string_view::npos);
        to.append(line.data(), line.data() + line.size());
    }
    std::unique_ptr<custom_flag_formatter> clone() const override {
        return std::make_unique<PrintableMessage>();
    }
};

} // namespace

void set_up_logging(bool quiet) {
    auto logger =
        std::make_shared<spdlog::logger>("onde", std::make_shared<spdlog::sinks::stderr_sink_mt>());
    auto line = std::make_unique<spdlog::pattern_formatter>();
    line->add_flag<PrintableMessage>('*').set_pattern("onde: %*");
    logger->set_formatter(std::move(line));
    logger->set_level(quiet ? spdlog::level::warn : spdlog::level::info);
    spdlog::set_default_logger(std::move(logger));
}

} // namespace onde
