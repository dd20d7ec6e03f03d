#include "core/files.h"

#include "core/error.h"

#include <fstream>

namespace onde {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path, uint64_t limit) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw InputError("{}: no such file; check the path", path.string());
    if (fs::is_directory(status))
        throw InputError("{}: is a folder; give the name of a file in it", path.string());
    if (!fs::is_regular_file(status))
        throw InputError("{}: not a regular file; give the path of a file", path.string());
    const uint64_t size = fs::file_size(path, error);
    if (error) throw InputError("{}: cannot be read ({})", path.string(), error.message());
    if (size > limit)
        throw InputError("{}: {} bytes is more than the {} bytes accepted here", path.string(),
                         size, limit);
    std::ifstream in(path, std::ios::binary);
    std::string bytes(size, '\0');
    if (!in || !in.read(bytes.data(), std::streamsize(size)))
        throw InputError("{}: cannot be read; check its permissions", path.string());
    return bytes;
}

std::string lower_extension(const fs::path& path) {
    std::string extension = path.extension().string();
    for (char& letter : extension)
        if (letter >= 'A' && letter <= 'Z') letter = char(letter - 'A' + 'a');
    return extension;
}

bool is_same_file(const std::filesystem::path& a, const std::filesystem::path& b) {
    const auto place = [](const std::filesystem::path& path) {
        std::error_code ignored;
        return std::filesystem::weakly_canonical(std::filesystem::absolute(path), ignored);
    };
    return place(a) == place(b);
}

} // namespace onde
