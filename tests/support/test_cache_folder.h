// Where compiled kernels that all tests share are kept, so that each program is compiled once.
#pragma once

#include <filesystem>

namespace onde::test {

/// Keyed by the sources, so that an edited kernel is compiled anew.
inline std::filesystem::path test_cache_folder() {
    return std::filesystem::temp_directory_path() / "onde-test-kernels";
}

} // namespace onde::test
