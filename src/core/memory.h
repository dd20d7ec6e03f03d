// How much memory the process may use.
#pragma once

#include <cstdint>

namespace onde {

/// Bytes of the machine's memory, or of the container's limit (cgroup) where that is less.
uint64_t available_memory();

} // namespace onde
