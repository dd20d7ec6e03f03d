#include "app/interrupt.h"

namespace onde::app {

// A signal handler can reach nothing else.
static std::atomic<bool> stop_requested{false};
static std::atomic<int> first_signal{SIGINT};

static void request_stop(int signal) {
    if (!stop_requested.exchange(true)) first_signal = signal;
    std::signal(signal, SIG_DFL);
}

StopOnInterrupt::StopOnInterrupt() {
    for (size_t i = 0; i < SIGNALS.size(); ++i) {
        previous_[i] = std::signal(SIGNALS[i], request_stop);
        if (SIGNALS[i] == SIGHUP && previous_[i] == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
    }
}

StopOnInterrupt::~StopOnInterrupt() {
    for (size_t i = 0; i < SIGNALS.size(); ++i) std::signal(SIGNALS[i], previous_[i]);
}

const std::atomic<bool>& StopOnInterrupt::requested() {
    return stop_requested;
}

int StopOnInterrupt::exit_code() {
    return 128 + first_signal;
}

} // namespace onde::app
