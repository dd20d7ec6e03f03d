// Compiled kernels that all tests share, so that each program is compiled once.
#pragma once

#include "gpu/program.h"

#include <filesystem>

namespace onde::test {

/// Keyed by the sources, so that an edited kernel is compiled anew.
inline const gpu::ProgramCache& test_cache() {
    static const gpu::ProgramCache cache(std::filesystem::temp_directory_path() /
                                         "onde-test-kernels");
    return cache;
}

} // namespace onde::test
