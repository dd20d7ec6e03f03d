// Compiled programs on disk. An entry is a magic word, a checksum of the binary, and the binary.
#include "core/files.h"
#include "core/hash.h"
#include "core/output.h"
#include "gpu/program.h"

#include <cstdlib>

namespace onde::gpu {
namespace fs = std::filesystem;
namespace {

constexpr std::string_view MAGIC = "ONDE-PROGRAM-1\n";
constexpr std::string_view EXTENSION = ".program";

std::string header(std::string_view binary) {
    return std::string(MAGIC) + Hasher().text(binary).hex() + "\n";
}

fs::path entry_path(const fs::path& folder, const std::string& key) {
    return folder / (key + std::string(EXTENSION));
}

/// The files of the folder that are ours.
std::vector<fs::path> entry_files(const fs::path& folder) {
    std::vector<fs::path> files;
    std::error_code ignored;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, ignored))
        if (entry.path().extension() == EXTENSION) files.push_back(entry.path());
    return files;
}

} // namespace

ProgramCache::ProgramCache(fs::path folder) : folder_(std::move(folder)) {}

fs::path ProgramCache::default_folder() {
    const auto variable = [](const char* name) {
        const char* value = std::getenv(name);
        return fs::path(value ? value : "");
    };
    if (const fs::path own = variable("ONDE_CACHE_DIR"); !own.empty()) return own;
    // The XDG specification: a relative path is to be ignored.
    if (const fs::path xdg = variable("XDG_CACHE_HOME"); xdg.is_absolute()) return xdg / "onde";
    if (const fs::path home = variable("HOME"); home.is_absolute()) return home / ".cache" / "onde";
    return {};
}

std::vector<ProgramCache::Entry> ProgramCache::list() const {
    std::vector<Entry> entries;
    for (const fs::path& file : entry_files(folder_)) {
        std::error_code gone; // another process may be clearing
        const uint64_t bytes = fs::file_size(file, gone);
        if (!gone) entries.push_back({file.stem().string(), bytes});
    }
    return entries;
}

size_t ProgramCache::clear() const {
    size_t removed = 0;
    remove_unfinished(folder_);
    std::error_code ignored;
    for (const fs::path& file : entry_files(folder_)) removed += fs::remove(file, ignored);
    return removed;
}

std::optional<std::string> ProgramCache::load(const std::string& key) const {
    if (folder_.empty()) return std::nullopt;
    try {
        const std::string entry = read_file(entry_path(folder_, key));
        const size_t header_size = header({}).size();
        if (entry.size() < header_size) return std::nullopt;
        std::string binary = entry.substr(header_size);
        if (!entry.starts_with(header(binary))) return std::nullopt;
        return binary;
    } catch (const std::exception&) { // absent or unreadable: a miss like any other
        return std::nullopt;
    }
}

void ProgramCache::store(const std::string& key, const std::string& binary) const {
    if (folder_.empty()) return;
    try {
        fs::create_directories(folder_);
        write_file(entry_path(folder_, key), header(binary) + binary);
    } catch (const std::exception&) { // a full or read-only disk only costs the next start time
    }
}

} // namespace onde::gpu
