// Room for recursions where the system gives programs little of it (ulimit -s).
#pragma once

#include <functional>

namespace onde {

/// Calls `work` with a stack of at least 8 MiB, on a thread of its own where this one's is smaller,
/// and gives as much to threads that are made from now on. `work` throws nothing.
void with_enough_stack(const std::function<void()>& work);

} // namespace onde
