#include "app/interrupt.h"

#include <csignal>

namespace onde::app {

// A signal handler can reach nothing else.
static std::atomic<bool> stop_requested{false};

StopOnInterrupt::StopOnInterrupt() {
    previous_ = std::signal(SIGINT, [](int) {
        stop_requested = true;
        std::signal(SIGINT, SIG_DFL);
    });
}

StopOnInterrupt::~StopOnInterrupt() {
    std::signal(SIGINT, previous_);
}

const std::atomic<bool>& StopOnInterrupt::requested() {
    return stop_requested;
}

} // namespace onde::app
