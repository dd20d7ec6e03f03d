// What the fuzz targets share: the bytes become a file, which must load or be refused by a
// sentence.
#pragma once

#include "core/error.h"
#include "scene/load.h"
#include "scene/loaders.h"

#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace onde::fuzz {

/// A folder of this process, in memory where there is one, removed at a normal end.
class Folder {
  public:
    Folder() {
        const bool memory = std::filesystem::is_directory("/dev/shm");
        path_ = memory ? "/dev/shm" : std::filesystem::temp_directory_path();
        path_ /= "onde-fuzz-" + std::to_string(::getpid());
        std::filesystem::create_directories(path_);
    }
    ~Folder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

inline const std::filesystem::path& folder() {
    static const Folder folder;
    return folder.path();
}

inline std::filesystem::path write(const std::string& name, std::string_view bytes) {
    const std::filesystem::path path = folder() / name;
    std::ofstream(path, std::ios::binary) << bytes;
    return path;
}

inline std::string_view text(const uint8_t* data, size_t size) {
    return {reinterpret_cast<const char*>(data), size};
}

/// Anything but a scene or an InputError of one line ends the fuzzer, as more memory than the
/// budget of a load does.
inline void load(const std::filesystem::path& path) {
    try {
        LoadContext context({.limit = uint64_t(256) << 20, .at = 0.5}); // animations too
        check_scene(load_part(path, context)); // completing it would take most of the time
    } catch (const InputError& error) {
        if (std::string_view(error.what()).find('\n') != std::string_view::npos) __builtin_trap();
    }
}

} // namespace onde::fuzz
