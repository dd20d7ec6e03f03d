#include "farm/store.h"

#include "core/abandoned.h"
#include "core/error.h"
#include "core/files.h"
#include "core/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <set>

namespace onde {
namespace fs = std::filesystem;

/// The longest text of a note.
static constexpr size_t MOST_NOTE = 1 << 16;

std::string name_of(const StoreKey& key) {
    return fmt::format("t{:04}-l{:02}-i{:06}", key.tile, key.level, key.index);
}

std::optional<StoreKey> key_of(const std::string& name) {
    StoreKey key;
    if (std::sscanf(name.c_str(), "t%u-l%u-i%u", &key.tile, &key.level, &key.index) != 3 ||
        key.level > 24 || name_of(key) != name)
        return std::nullopt;
    return key;
}

Store::Store(const fs::path& folder, double lease_seconds)
    : folder_(folder), lease_seconds_(lease_seconds) {
    std::error_code error;
    is_made_ = !fs::exists(folder, error);
    for (const char* name : {"leases", "notes"}) fs::create_directories(folder / name, error);
    if (error)
        throw InputError("{}: cannot be a store ({}); choose another folder", folder.string(),
                         error.message());
    check_folder_writable(folder);
}

fs::path Store::path(const StoreKey& key) const {
    return folder_ / (name_of(key) + ".exr");
}

std::vector<StoreKey> Store::list() const {
    std::set<StoreKey> keys;
    std::error_code error;
    for (fs::directory_iterator at(folder_, error), end; !error && at != end; at.increment(error))
        if (at->path().extension() == ".exr")
            if (const auto key = key_of(at->path().stem().string())) keys.insert(*key);
    std::vector<StoreKey> own;
    for (const StoreKey& key : keys) {
        bool is_joined = false;
        for (StoreKey above = key; above.level < 24 && !is_joined;) {
            above = above.parent();
            is_joined = keys.contains(above);
        }
        if (is_joined)
            remove(key); // by a worker that was late, or that died before it removed it
        else
            own.push_back(key);
    }
    return own;
}

void Store::remove(const StoreKey& key) const {
    std::error_code ignored;
    fs::remove(path(key), ignored);
}

/// Whether a lease or a note of a store is called so, and no file of somebody else's.
static bool is_name_of_store(const std::string& name) {
    std::string_view core = name;
    for (const std::string_view before : {"join-", "verify-"})
        if (core.starts_with(before)) core.remove_prefix(before.size());
    const std::string stem(core.substr(0, core.find('.')));
    return name == "plan" || name == "film" || name.starts_with(".clock-") || key_of(stem);
}

void Store::remove_all() const {
    std::error_code ignored;
    for (const StoreKey& key : list()) remove(key);
    for (const char* name : {"leases", "notes"}) {
        std::vector<fs::path> own;
        for (fs::directory_iterator at(folder_ / name, ignored), end; !ignored && at != end;
             at.increment(ignored))
            if (is_name_of_store(at->path().filename().string())) own.push_back(at->path());
        for (const fs::path& path : own) fs::remove(path, ignored);
        fs::remove(folder_ / name, ignored); // if it is empty, as below
    }
    fs::remove(folder_, ignored);
}

void Store::remove_if_unused() const {
    std::error_code ignored;
    if (!is_made_) return;
    for (const fs::path& path : {folder_ / "leases", folder_ / "notes", folder_})
        fs::remove(path, ignored); // stays where anything is in it
}

fs::path Store::lease(const std::string& name) const {
    return folder_ / "leases" / name;
}

/// By the times that the store itself gives to files.
bool Store::has_expired(const fs::path& lease) const {
    struct stat then {
    }, now{};
    const fs::path clock = folder_ / "leases" / fmt::format(".clock-{}", getpid());
    const Descriptor made(open(clock.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666));
    const bool known = made && write(made.get(), "x", 1) == 1 && fstat(made.get(), &now) == 0;
    unlink(clock.c_str());
    if (!known || stat(lease.c_str(), &then) != 0) return false;
    return std::abs(double(now.st_mtime - then.st_mtime)) > lease_seconds_;
}

bool Store::claim(const std::string& name) const {
    const fs::path path = lease(name);
    for (int attempt = 0; attempt < 2; attempt++) {
        const Descriptor made(open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (made) return true;
        if (errno != EEXIST) // a full disk, for example
            throw InputError("{}: cannot be made ({}); the store has to be writable", path.string(),
                             std::error_code(errno, std::generic_category()).message());
        if (!has_expired(path)) return false;
        unlink(path.c_str());
    }
    return false;
}

void Store::renew(const std::string& name) const {
    utimensat(AT_FDCWD, lease(name).c_str(), nullptr, 0);
}

void Store::release(const std::string& name) const {
    unlink(lease(name).c_str());
}

uint32_t Store::count_leases() const {
    uint32_t held = 0;
    std::error_code error;
    for (fs::directory_iterator at(folder_ / "leases", error), end; !error && at != end;
         at.increment(error))
        held += !at->path().filename().string().starts_with('.') && !has_expired(at->path());
    return held;
}

std::vector<std::string> Store::notes(const std::string& ending) const {
    std::vector<std::string> names;
    std::error_code error;
    for (fs::directory_iterator at(folder_ / "notes", error), end; !error && at != end;
         at.increment(error))
        if (at->path().filename().string().ends_with(ending))
            names.push_back(at->path().filename().string());
    return names;
}

void Store::put(const std::string& name, const std::string& text) const {
    write_file(folder_ / "notes" / name, text);
}

std::optional<std::string> Store::get(const std::string& name) const {
    try {
        return read_file(folder_ / "notes" / name, MOST_NOTE);
    } catch (const InputError&) {
        return std::nullopt; // not there, as yet
    }
}

} // namespace onde
