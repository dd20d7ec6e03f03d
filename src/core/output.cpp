#include "core/output.h"

#include "core/abandoned.h"
#include "core/error.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <optional>

namespace onde {
namespace fs = std::filesystem;
namespace {

/// Of every unfinished file; the rest of its name is of no meaning.
constexpr std::string_view UNFINISHED = ".onde-unfinished-";

std::optional<struct stat> status_of(const fs::path& path) {
    struct stat status {};
    if (stat(path.c_str(), &status) != 0) return std::nullopt;
    return status;
}

std::string last_error() {
    return std::error_code(errno, std::generic_category()).message();
}

/// Where a file of that name would really be: behind its links, though the last may lead to nothing
/// as yet.
fs::path follow_links(fs::path path) {
    constexpr int MOST_LINKS = 40;
    std::error_code error;
    for (int i = 0; i < MOST_LINKS; ++i) {
        if (!fs::is_symlink(fs::symlink_status(path, error))) return path;
        path = path.parent_path() / fs::read_symlink(path, error);
    }
    throw InputError("{}: its symbolic links lead in a circle; choose another output",
                     path.string());
}

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

/// While it lives, a closed pipe or a limit on the size of files is an error of write() and does
/// not end the program.
class SignalsOfWriting {
  public:
    SignalsOfWriting() {
        sigemptyset(&signals_);
        sigaddset(&signals_, SIGPIPE);
        sigaddset(&signals_, SIGXFSZ);
        pthread_sigmask(SIG_BLOCK, &signals_, &before_);
    }
    ~SignalsOfWriting() {
        const int error = errno; // of write(), for who asks
        const timespec at_once{};
        while (sigtimedwait(&signals_, nullptr, &at_once) > 0) {
        }
        pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        errno = error;
    }
    SignalsOfWriting(const SignalsOfWriting&) = delete;
    SignalsOfWriting& operator=(const SignalsOfWriting&) = delete;

  private:
    sigset_t signals_{}, before_{};
};

/// Returns false, with errno set, when not all could be written.
bool write_all(int descriptor, std::string_view bytes) {
    const SignalsOfWriting signals;
    while (!bytes.empty()) {
        const ssize_t written = ::write(descriptor, bytes.data(), bytes.size());
        if (written < 0 && errno != EINTR) return false;
        if (written > 0) bytes.remove_prefix(size_t(written));
    }
    return true;
}

void write_to_standard_output(std::string_view bytes) {
    std::fflush(stdout); // what was printed comes first
    if (!write_all(STDOUT_FILENO, bytes))
        throw InputError("standard output could not be written ({})", last_error());
}

void write_through(const fs::path& path, std::string_view bytes) {
    const Descriptor open(::open(path.c_str(), O_WRONLY | O_NOCTTY | O_CLOEXEC));
    if (!open || !write_all(open.get(), bytes))
        throw InputError("{}: cannot be written ({}); choose another output", path.string(),
                         last_error());
}

/// A file of no content beside its target, removed unless it takes the target's place.
class Unfinished {
  public:
    explicit Unfinished(const fs::path& folder);
    ~Unfinished() {
        if (!path_.empty()) unlink(path_.c_str());
    }
    Unfinished(const Unfinished&) = delete;
    Unfinished& operator=(const Unfinished&) = delete;

    explicit operator bool() const { return bool(file_); }

    /// Each returns false with errno set when it fails.
    bool write_at(uint64_t offset, std::string_view bytes) const;
    bool is_stored(uint64_t bytes) const; ///< that many, on the disk
    bool replace(const fs::path& target);
    void resemble(const struct stat& old) const;

  private:
    fs::path path_; ///< empty: nowhere, or not ours any more
    Descriptor file_;
};

Unfinished::Unfinished(const fs::path& folder) {
    static std::atomic<unsigned> counter{0};
    constexpr int TRIES = 100;
    for (int i = 0; i < TRIES; ++i) {
        path_ = folder / fmt::format("{}{}-{}", UNFINISHED, getpid(), counter++);
        file_ = Descriptor(open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
        if (file_ && hold(file_)) return;
        if (!file_ && errno != EEXIST) break; // the number is another container's process
    }
    path_.clear();
}

bool Unfinished::write_at(uint64_t offset, std::string_view bytes) const {
    return lseek(file_.get(), off_t(offset), SEEK_SET) >= 0 && write_all(file_.get(), bytes);
}

bool Unfinished::is_stored(uint64_t bytes) const {
    struct stat status {};
    if (fsync(file_.get()) != 0 || fstat(file_.get(), &status) != 0) return false;
    errno = EIO;
    return uint64_t(status.st_size) == bytes;
}

void Unfinished::resemble(const struct stat& old) const {
    const bool ours = fchown(file_.get(), old.st_uid, old.st_gid) == 0 ||
                      fchown(file_.get(), uid_t(-1), old.st_gid) == 0;
    fchmod(file_.get(), old.st_mode & (ours ? 07777 : 0777));
}

bool Unfinished::replace(const fs::path& target) {
    if (rename(path_.c_str(), target.c_str()) != 0) return false;
    path_.clear();
    // The name too has to last; file systems that can't are left to it.
    const Descriptor folder(open(folder_of(target).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
    if (folder) fsync(folder.get());
    return true;
}

void check_file(const fs::path& path, const std::optional<struct stat>& status) {
    if (path.filename().empty() || (status && S_ISDIR(status->st_mode)))
        throw InputError("{}: is a folder; give the name of a file in it", path.string());
    if (!status) return;
    constexpr mode_t WRITABLE = S_IWUSR | S_IWGRP | S_IWOTH; // root may write, but should not here
    if (access(path.c_str(), W_OK) != 0 || !(status->st_mode & WRITABLE))
        throw InputError("{}: is read-only; make it writable or choose another output",
                         path.string());
}

[[noreturn]] void throw_unwritable(const fs::path& folder, const fs::path& path) {
    const std::string reason = last_error();
    if (!fs::is_directory(folder))
        throw InputError("{}: the folder {} does not exist; create it first", path.string(),
                         folder.string());
    throw InputError("{}: the folder {} is not writable ({}); choose another output", path.string(),
                     folder.string(), reason);
}

} // namespace

bool is_standard_output(const fs::path& path) {
    if (path == STANDARD_OUTPUT) return true;
    struct stat output {};
    const auto status = status_of(path);
    return status && fstat(STDOUT_FILENO, &output) == 0 && status->st_dev == output.st_dev &&
           status->st_ino == output.st_ino;
}

struct WholeFile::State {
    fs::path path, target;
    std::optional<struct stat> old;
    std::unique_ptr<Unfinished> file{};
    uint64_t size = 0;

    [[noreturn]] void fail() const {
        throw InputError("{}: cannot be written ({}); {}choose another output", path.string(),
                         last_error(), old ? "the old file is as it was; " : "");
    }
};

WholeFile::WholeFile(const fs::path& path)
    : state_(std::make_unique<State>(State{path, follow_links(path), status_of(path)})) {
    check_file(path, state_->old);
    if (is_standard_output(path) || (state_->old && !S_ISREG(state_->old->st_mode)))
        throw InputError("{}: is a pipe or a device, and this is written in no order; name a file",
                         path.string());
    const fs::path folder = folder_of(state_->target);
    remove_abandoned(folder, UNFINISHED);
    state_->file = std::make_unique<Unfinished>(folder);
    if (!*state_->file) throw_unwritable(folder, path);
    if (state_->old) state_->file->resemble(*state_->old);
}

WholeFile::~WholeFile() = default;

void WholeFile::write_at(uint64_t offset, std::string_view bytes) {
    if (!state_->file->write_at(offset, bytes)) state_->fail();
    state_->size = std::max(state_->size, offset + bytes.size());
}

void WholeFile::finish() {
    if (!state_->file->is_stored(state_->size) || !state_->file->replace(state_->target))
        state_->fail();
}

void write_file(const fs::path& path, std::string_view bytes) {
    if (is_standard_output(path)) return write_to_standard_output(bytes);
    const auto status = status_of(path);
    check_file(path, status);
    if (status && !S_ISREG(status->st_mode)) return write_through(path, bytes);
    WholeFile file(path);
    file.write_at(0, bytes);
    file.finish();
}

void check_writable(const fs::path& path) {
    WritableCheck().check(path);
}

void WritableCheck::check(const fs::path& path) {
    if (is_standard_output(path)) return;
    const auto status = status_of(path);
    check_file(path, status);
    if (status && !S_ISREG(status->st_mode)) return;
    const fs::path folder = folder_of(follow_links(path));
    if (folders_.contains(folder)) return;
    if (!Unfinished(folder)) throw_unwritable(folder, path);
    folders_.insert(folder);
}

void check_folder_writable(const fs::path& folder) {
    std::error_code ignored;
    if (!fs::is_directory(folder, ignored))
        throw InputError("{}: is no folder; name another for the output", folder.string());
    if (!Unfinished(folder))
        throw InputError("{}: this folder is not writable ({}); name another for the output",
                         folder.string(), last_error());
}

void check_not_read(const fs::path& path, std::span<const fs::path> files) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return; // what is not there is not read either
    for (const fs::path& file : files)
        if (fs::equivalent(path, file, error))
            throw InputError("{}: is read from here, so nothing can be written to it; name another "
                             "file",
                             path.string());
}

void remove_unfinished(const fs::path& folder) {
    remove_abandoned(folder, UNFINISHED);
}

void Outputs::check() const {
    if (failures_.empty()) return;
    if (failures_.size() == 1) throw InputError(failures_.front());
    std::string all = fmt::format("{} outputs could not be written:", failures_.size());
    for (const std::string& failure : failures_) all += "\n  " + failure;
    throw InputError(all);
}

} // namespace onde
