#include "gpu/pocl_environment.h"

#include "core/abandoned.h"
#include "gpu/program.h"

#include <fmt/ranges.h>

#include <cstdlib>
#include <fcntl.h>
#include <stdlib.h>
#include <sys/statvfs.h>
#include <unistd.h>

namespace onde::gpu {
namespace fs = std::filesystem;
namespace {

std::string variable(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// The user's value stays.
void set_default(const char* name, const std::string& value) {
    setenv(name, value.c_str(), 0);
}

/// Whether files can be made there, of the size of what PoCL compiles at a time, and be executed.
bool has_room(const std::string& folder) {
    constexpr uint64_t ROOM = 64 << 20;
    struct statvfs disk {};
    return access(folder.c_str(), W_OK | X_OK) == 0 && statvfs(folder.c_str(), &disk) == 0 &&
           uint64_t(disk.f_bavail) * disk.f_frsize >= ROOM && !(disk.f_flag & ST_NOEXEC);
}

constexpr const char* SCRATCH = "onde-pocl-";

/// A folder of this process, gone at exit; those of processes that were killed go with the next.
class Scratch {
  public:
    /// In the first of the parents that has room; nowhere when none has.
    explicit Scratch(const std::vector<std::string>& parents) {
        for (const std::string& parent : parents) {
            remove_abandoned(parent, SCRATCH);
            std::string name = parent + "/" + SCRATCH + "XXXXXX";
            if (!has_room(parent) || !mkdtemp(name.data())) continue;
            in_use_ = Descriptor(open(name.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
            if (!in_use_ || !hold(in_use_)) continue;
            path_ = name;
            return;
        }
    }
    ~Scratch() {
        std::error_code ignored;
        if (!path_.empty()) fs::remove_all(path_, ignored);
    }
    Scratch(const Scratch&) = delete;
    Scratch& operator=(const Scratch&) = delete;

    const fs::path& path() const { return path_; }

  private:
    fs::path path_; ///< empty: nowhere
    Descriptor in_use_;
};

std::vector<std::string> scratch_parents() {
    std::vector<std::string> parents{variable("TMPDIR"), "/tmp", "/var/tmp", "/dev/shm",
                                     ProgramCache::default_folder().string()};
    std::erase(parents, "");
    return parents;
}

/// Returns what is wrong, or nothing.
std::string give_scratch() {
    set_default("POCL_KERNEL_CACHE", "0");
    if (const std::string users = variable("POCL_CACHE_DIR"); !users.empty()) {
        std::error_code ignored;
        fs::create_directories(users, ignored);
        if (has_room(users)) return {};
        return fmt::format("it compiles in POCL_CACHE_DIR, which names {}, where it cannot write "
                           "or has no room",
                           users);
    }
    static const Scratch scratch(scratch_parents());
    if (scratch.path().empty())
        return fmt::format("it compiles in a folder, and none of {} has room for it or can be "
                           "written to; name one in TMPDIR",
                           fmt::join(scratch_parents(), ", "));
    set_default("POCL_CACHE_DIR", scratch.path().string());
    return {};
}

/// PoCL has its kernels linked by the system's linker. Returns what is wrong, or nothing.
std::string find_linker() {
    set_default("PATH", "/usr/local/bin:/usr/bin:/bin");
    const std::string path = variable("PATH");
    for (size_t begin = 0; begin <= path.size();) {
        const size_t end = std::min(path.find(':', begin), path.size());
        const fs::path linker = fs::path(path.substr(begin, end - begin)) / "ld";
        if (access(linker.c_str(), X_OK) == 0) return {};
        begin = end + 1;
    }
    return fmt::format("it links kernels with ld, which is not in the PATH {}; install binutils",
                       path);
}

/// hwloc, by which PoCL counts, finds neither processors nor memory where there is no /sys.
void describe_machine() {
    if (fs::exists("/sys/devices/system/cpu")) return;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN), pages = sysconf(_SC_PHYS_PAGES);
    const int64_t bytes = int64_t(pages) * sysconf(_SC_PAGESIZE);
    if (processors < 1 || bytes < 1) return;
    set_default("HWLOC_SYNTHETIC", fmt::format("node:1(memory={}) pu:{}", bytes, processors));
    set_default("HWLOC_THISSYSTEM", "1");
}

/// PoCL compiles a kernel for the group size of its launch, and all kernels again, for groups of
/// any size, when asked for the program's binary. The latter run as fast here and are enough.
void have_it_compile_once() {
    set_default("POCL_WORK_GROUP_SPECIALIZATION", "0");
}

} // namespace

std::string prepare_pocl() {
    have_it_compile_once();
    describe_machine();
    const std::string no_scratch = give_scratch(), no_linker = find_linker();
    return no_scratch.empty() ? no_linker : no_scratch;
}

} // namespace onde::gpu
