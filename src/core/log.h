// Lines for the user, on standard error. Standard output is kept for what a script may read.
#pragma once

#include <spdlog/spdlog.h>

namespace onde {

/// Sends plain lines ("onde: ...") to standard error; `quiet` keeps only warnings and errors.
void set_up_logging(bool quiet);

} // namespace onde
