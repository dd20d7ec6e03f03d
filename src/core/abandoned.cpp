#include "core/abandoned.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <utility>

namespace onde {
namespace fs = std::filesystem;

Descriptor& Descriptor::operator=(Descriptor&& other) noexcept {
    close();
    number_ = other.release();
    return *this;
}

void Descriptor::close() {
    if (number_ >= 0) ::close(std::exchange(number_, -1));
}

int Descriptor::release() {
    return std::exchange(number_, -1);
}

bool hold(const Descriptor& open) {
    flock(open.get(), LOCK_EX); // file systems without locks have nothing removed from them
    struct stat status {};
    return fstat(open.get(), &status) == 0 && status.st_nlink > 0;
}

bool try_hold(const Descriptor& open) {
    return flock(open.get(), LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK;
}

static void remove_if_abandoned(const fs::path& path) {
    struct stat status {};
    if (lstat(path.c_str(), &status) != 0 || status.st_uid != geteuid()) return;
    const bool folder = S_ISDIR(status.st_mode);
    if (!folder && !S_ISREG(status.st_mode)) return;
    const int access = folder ? O_RDONLY | O_DIRECTORY : O_RDWR; // NFS locks what can be written
    const Descriptor open(::open(path.c_str(), access | O_NOFOLLOW | O_CLOEXEC));
    if (!open || flock(open.get(), LOCK_EX | LOCK_NB) != 0) return;
    std::error_code ignored;
    fs::remove_all(path, ignored);
}

void remove_abandoned(const fs::path& folder, std::string_view prefix) noexcept try {
    std::error_code ignored;
    for (fs::directory_iterator entry(folder, ignored), end; !ignored && entry != end;
         entry.increment(ignored))
        if (entry->path().filename().string().starts_with(prefix))
            remove_if_abandoned(entry->path());
} catch (const std::exception&) { // what stays costs space only
}

} // namespace onde
