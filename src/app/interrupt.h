// Ctrl-C as a flag that long work looks at.
#pragma once

#include <atomic>

namespace onde::app {

/// While it lives, the first Ctrl-C sets the flag; the second one kills the program.
class StopOnInterrupt {
  public:
    StopOnInterrupt();
    ~StopOnInterrupt();
    StopOnInterrupt(const StopOnInterrupt&) = delete;
    StopOnInterrupt& operator=(const StopOnInterrupt&) = delete;

    /// True from the first Ctrl-C on.
    static const std::atomic<bool>& requested();

  private:
    void (*previous_)(int);
};

} // namespace onde::app
