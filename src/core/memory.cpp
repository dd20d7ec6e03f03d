#include "core/memory.h"

#include <algorithm>
#include <fstream>
#include <unistd.h>

namespace onde {

uint64_t available_memory() {
    uint64_t bytes = uint64_t(::sysconf(_SC_PHYS_PAGES)) * uint64_t(::sysconf(_SC_PAGE_SIZE));
    for (const char* path :
         {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"}) {
        uint64_t limit = 0; // "max" is no number and leaves it
        if (std::ifstream(path) >> limit && limit > 0) bytes = std::min(bytes, limit);
    }
    return bytes;
}

} // namespace onde
