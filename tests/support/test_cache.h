#pragma once

#include "gpu/program.h"
#include "support/test_cache_folder.h"

namespace onde::test {

inline const gpu::ProgramCache& test_cache() {
    static const gpu::ProgramCache cache(test_cache_folder());
    return cache;
}

} // namespace onde::test
