// Requests to end (Ctrl-C, SIGTERM, SIGHUP) as a flag that long work looks at.
#pragma once

#include <array>
#include <atomic>
#include <csignal>

namespace onde::app {

/// While it lives, each of these signals sets the flag once; a second one of the same kind kills
/// the program. A SIGHUP that was ignored from the start (nohup) stays ignored.
class StopOnInterrupt {
  public:
    StopOnInterrupt();
    ~StopOnInterrupt();
    StopOnInterrupt(const StopOnInterrupt&) = delete;
    StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

    /// True from the first signal on.
    static const std::atomic<bool>& requested();

    /// What a program ended by the signal that came first answers to its shell: 128 and the
    /// signal's number; as for Ctrl-C where none came.
    static int exit_code();

  private:
    static constexpr std::array SIGNALS{SIGINT, SIGTERM, SIGHUP};
    std::array<void (*)(int), SIGNALS.size()> previous_;
};

} // namespace onde::app
