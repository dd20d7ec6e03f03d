// Scene files written by a test into a folder of its own.
#pragma once

#include "core/error.h"
#include "scene/load.h"

#include <catch2/catch.hpp>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

namespace onde::test {

/// A fresh folder that is removed with everything in it.
class ScratchFolder {
  public:
    ScratchFolder() {
        static std::atomic<unsigned> counter{0};
        path_ = std::filesystem::temp_directory_path() /
                ("onde-scene-test-" + std::to_string(::getpid()) + "-" + std::to_string(counter++));
        std::filesystem::create_directories(path_);
    }
    ~ScratchFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

    std::filesystem::path write(const std::string& name, std::string_view content) const {
        const std::filesystem::path file = path_ / name;
        std::filesystem::create_directories(file.parent_path());
        std::ofstream(file, std::ios::binary) << content;
        return file;
    }

  private:
    std::filesystem::path path_;
};

/// The bytes of the values, one after the other.
template <class T>
std::string bytes_of(std::initializer_list<T> values) {
    std::string bytes(values.size() * sizeof(T), '\0');
    std::memcpy(bytes.data(), values.begin(), bytes.size());
    return bytes;
}

inline bool has_note(const Scene& scene, const std::string& text) {
    return std::ranges::any_of(
        scene.notes, [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

/// The InputError's sentence when the scene is loaded, or "" when it loads. Any other exception
/// escapes and fails the test.
inline std::string load_error(const std::filesystem::path& path) {
    try {
        load_scene(path);
        return "";
    } catch (const InputError& error) {
        return error.what();
    }
}

/// A PNG file of one texel of (64, 128, 255, 255).
inline std::string blue_png() {
    static constexpr unsigned char BYTES[] = {
        137, 80,  78,  71, 13, 10,  26,  10, 0,   0,   0,   13,  73,  72,  68,  82,  0, 0,
        0,   1,   0,   0,  0,  1,   8,   6,  0,   0,   0,   31,  21,  196, 137, 0,   0, 0,
        13,  73,  68,  65, 84, 120, 156, 99, 112, 104, 248, 255, 31,  0,   5,   130, 2, 191,
        227, 174, 126, 81, 0,  0,   0,   0,  73,  69,  78,  68,  174, 66,  96,  130};
    return std::string(reinterpret_cast<const char*>(BYTES), sizeof(BYTES));
}

} // namespace onde::test
