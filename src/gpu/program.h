// From kernel files to kernels that can be launched: sources, compilation, our own binary cache.
#pragma once

#include "gpu/buffer.h"
#include "gpu/device.h"
#include "gpu/profiler.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace onde::gpu {

/// Where kernel files come from: embedded in the binary, or a folder for live editing.
class KernelSources {
  public:
    static KernelSources embedded();
    static KernelSources folder(std::filesystem::path root); ///< throws InputError if it is none
    /// The folder's, or the embedded ones where no folder is named.
    static KernelSources from(const std::filesystem::path& root);

    /// The text of a file named relative to kernels/, for example "math/lanes.h".
    /// Throws DeviceError naming the file when there is none.
    std::string read(const std::string& file) const;

    /// `file` with every #include "..." replaced by that file, once each (as if by #pragma once),
    /// with #line directives so that build logs name our files and lines. Names are relative to
    /// kernels/. An #include must not stand under an #if that may be false: the one text of a file
    /// lands at its first mention. Throws DeviceError naming the file and line of an #include of a
    /// file that there is not.
    std::string flatten(const std::string& file) const;
    /// The same of several files, one after the other.
    std::string flatten(const std::vector<std::string>& files) const;

    /// Of the names and texts of all files.
    std::string hash() const;

  private:
    std::optional<std::filesystem::path> root_;
};

/// A kernel of a program and the one local size that it is ever launched with.
/// Rule for every kernel of ours: its first parameter is `uint count`, and it returns at once
/// when count is 0, touching nothing else. That is how programs are warmed for the cache: with
/// small buffers of zeros, since compilers move loads ahead of that test.
struct KernelShape {
    std::string name;
    /// Fewer where the compiled kernel does not take as many, and what the kernel itself requires
    /// where it does (reqd_work_group_size).
    size_t local_size = 1;
    /// About the most work items of one launch. PoCL compiles a kernel again for grids that reach
    /// 65535 items, so a launch beyond that, not announced here, pays for it when it comes.
    size_t items = 1;
};

struct ProgramRequest {
    std::string file;                 ///< relative to kernels/
    std::vector<std::string> defines; ///< "NAME=VALUE"
    /// Those that will be launched. Name all of the file: PoCL compiles the unnamed ones as well,
    /// for no particular local size, when it hands out the binary.
    std::vector<KernelShape> kernels;
    /// Files whose text comes before that of `file`: what it leaves open, such as the layout of the
    /// BVH or the estimator that a scheduler drives.
    std::vector<std::string> before = {};
};

struct BuildReport {
    double seconds = 0;      ///< everything: flatten, compile or load, first launches
    bool from_cache = false; ///< nothing was compiled
};

/// A kernel with its constant local size. Copyable handle; arguments belong to the handle's kernel.
class Kernel {
  public:
    Kernel() = default;
    Kernel(cl::Kernel kernel, KernelShape shape, const Device& device);

    const std::string& name() const { return shape_.name; }

    /// Sets one argument: a trivially copyable value or a Buffer, which must live until the launch.
    /// Throws DeviceError naming kernel and argument when the size does not fit.
    template <class T>
    void set(uint32_t index, const T& value);
    template <class T>
    void set(uint32_t index, const Buffer<T>& buffer);
    /// Sets arguments first, first + 1, ...; returns the next index.
    template <class... Args>
    uint32_t set_from(uint32_t first, const Args&... args);

    /// Queues at least `items` work items (rounded up to the local size; kernels check their
    /// count); none for 0 items. Throws DeviceError naming the kernel.
    void launch(size_t items, Profiler* profiler = nullptr);

    /// Work items of a group, as every launch has them.
    size_t local_size() const { return shape_.local_size; }

  private:
    void set_bytes(uint32_t index, size_t size, const void* value);
    void set_memory(uint32_t index, const cl::Buffer& buffer);

    cl::Kernel kernel_;
    KernelShape shape_;
    cl::CommandQueue queue_;
};

class Program {
  public:
    Program(std::vector<Kernel> kernels, BuildReport report)
        : kernels_(std::move(kernels)), report_(report) {}
    /// Throws DeviceError if the request did not name it.
    Kernel& kernel(std::string_view name);
    const BuildReport& report() const { return report_; }

  private:
    std::vector<Kernel> kernels_;
    BuildReport report_;
};

/// Binaries on disk, one file per key. Default folder: $ONDE_CACHE_DIR, else
/// $XDG_CACHE_HOME/onde, else ~/.cache/onde. A damaged entry is a miss. Writes are atomic and
/// failures to write are silent: a cache is never a reason to fail.
class ProgramCache {
  public:
    explicit ProgramCache(std::filesystem::path folder = default_folder());
    /// Empty, which makes a cache that never holds anything, where the environment has no home.
    static std::filesystem::path default_folder();
    const std::filesystem::path& folder() const { return folder_; }

    struct Entry {
        std::string key;
        uint64_t bytes = 0;
    };
    std::vector<Entry> list() const;
    size_t clear() const; ///< returns how many entries went
    std::optional<std::string> load(const std::string& key) const;
    void store(const std::string& key, const std::string& binary) const;

  private:
    std::filesystem::path folder_;
};

/// The programs of one device: where their text comes from, where binaries are kept, and all that
/// were built so far. For one thread at a time.
class Programs {
  public:
    /// Without a cache, binaries are neither read from disk nor kept there. The device outlives it.
    Programs(const Device& device, KernelSources sources, std::optional<ProgramCache> cache = {});
    Programs(const Programs&) = delete;
    Programs& operator=(const Programs&) = delete;

    const Device& device() const { return device_; }
    const KernelSources& sources() const { return sources_; }

    /// Compiles or loads the program and launches each kernel once, empty, at its local size,
    /// before a binary is taken. What was built before from the same text and options gives kernel
    /// objects of its own at once. Throws DeviceError with the build log, which names our files.
    Program build(const ProgramRequest& request);

    /// How many programs were compiled or loaded so far.
    size_t built() const { return built_.size(); }

  private:
    const Device& device_;
    KernelSources sources_;
    std::optional<ProgramCache> cache_;
    std::map<std::string, cl::Program> built_; ///< by cache key
};

/// The compiler options that follow from the device alone: language version, argument info, correct
/// rounding, and ONDE_CPU, ONDE_AVX2, ONDE_AVX512 as 0 or 1, each option as "-D..." or "-cl-...".
/// The latter two are 1 only on PoCL on x86, whose compiler takes x86 builtins; kernels also ask
/// __AVX512F__ and the like, as a compiler may aim lower than the host.
std::vector<std::string> device_options(const DeviceFacts& facts);

} // namespace onde::gpu

#include "gpu/program_impl.h"
