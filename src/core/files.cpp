#include "core/files.h"

#include "core/error.h"

#include <atomic>
#include <fstream>
#include <unistd.h>

namespace onde {
namespace fs = std::filesystem;

std::string read_file(const fs::path& path, uint64_t limit) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw InputError("{}: no such file; check the path", path.string());
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

static fs::path temporary_beside(const fs::path& path) {
    static std::atomic<unsigned> counter{0};
    fs::path name = path.stem();
    name += fmt::format(".{}-{}.tmp", ::getpid(), counter++);
    name += path.extension();
    return path.parent_path() / name;
}

void replace_file(const fs::path& path, const std::function<void(const fs::path&)>& write) {
    const fs::path temporary = temporary_beside(path);
    std::error_code ignored;
    try {
        write(temporary);
        fs::rename(temporary, path);
    } catch (const fs::filesystem_error& error) {
        fs::remove(temporary, ignored);
        throw InputError("{}: cannot be written ({})", path.string(), error.code().message());
    } catch (...) {
        fs::remove(temporary, ignored);
        throw;
    }
}

void write_text(const fs::path& path, std::string_view text) {
    replace_file(path, [&](const fs::path& temporary) {
        std::ofstream out(temporary, std::ios::binary);
        out << text;
        if (!out.flush()) throw InputError("{}: cannot be written", path.string());
    });
}

void check_writable(const fs::path& path) {
    const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
    std::error_code error;
    if (path.filename().empty() || fs::is_directory(path, error))
        throw InputError("{}: is a folder; give the name of a file in it", path.string());
    if (!fs::is_directory(folder, error))
        throw InputError("{}: the folder {} does not exist; create it first", path.string(),
                         folder.string());
    const fs::path probe = temporary_beside(path);
    const bool created = bool(std::ofstream(probe, std::ios::binary));
    fs::remove(probe, error);
    if (!created)
        throw InputError("{}: the folder {} is not writable; choose another output", path.string(),
                         folder.string());
}

} // namespace onde
