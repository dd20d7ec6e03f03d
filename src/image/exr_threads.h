// Threads of OpenEXR's library, which reads and writes large pictures while nothing else is done.
#pragma once

#include <ImfThreading.h>

namespace onde {

inline void limit_exr_threads() {
    static const bool done = [] {
        constexpr int THREADS = 4;
        Imf::setGlobalThreadCount(THREADS);
        return true;
    }();
    (void)done;
}

} // namespace onde
