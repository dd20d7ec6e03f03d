// A folder of its own for each test, and the smallest of file writers.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace onde::test {

/// A fresh folder that is removed with everything in it.
struct Folder {
    std::filesystem::path path =
        std::filesystem::temp_directory_path() / ("onde-core-test-" + std::to_string(::getpid()));
    Folder() { std::filesystem::create_directories(path); }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

    size_t count() const {
        return size_t(std::distance(std::filesystem::directory_iterator(path),
                                    std::filesystem::directory_iterator()));
    }
};

inline void write(const std::filesystem::path& path, std::string_view text) {
    std::ofstream(path, std::ios::binary) << text;
}

} // namespace onde::test
