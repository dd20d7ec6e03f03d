// Files out: a file that is replaced is old or new as a whole, whatever happens meanwhile; devices,
// pipes and standard output are written through.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace onde {

/// What stands for standard output among the names of files.
inline constexpr const char* STANDARD_OUTPUT = "-";

/// Whether this is standard output: "-", or a name of what it is connected to (/dev/stdout).
bool is_standard_output(const std::filesystem::path& path);

/// Makes these bytes the content of `path`. A file is written beside its target, checked, and
/// renamed over it: it keeps its mode, and its owner where that is permitted; symbolic links are
/// followed and stay. Throws InputError, with the old file as it was, when it can't be written or
/// is read-only.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// A file that is written piece by piece and then takes its target's place as a whole, as
/// write_file() has it. Where it goes out of scope before, the old file is as it was.
class WholeFile {
  public:
    /// Throws InputError where there can be no such file, as at a pipe or a device.
    explicit WholeFile(const std::filesystem::path& path);
    ~WholeFile();

    /// Each throws InputError when the disk is full, for example.
    void write_at(uint64_t offset, std::string_view bytes);
    void finish();

  private:
    struct State;
    std::unique_ptr<State> state_;
};

/// Throws InputError unless `path` could be written now: its folder exists and is writable, it is
/// no folder and not read-only. Leaves nothing behind and touches nothing.
void check_writable(const std::filesystem::path& path);

/// The same for many paths, where each folder is tried once.
class WritableCheck {
  public:
    void check(const std::filesystem::path& path);

  private:
    std::set<std::filesystem::path> folders_; ///< that are writable
};

/// Throws InputError unless files can be made in the folder.
void check_folder_writable(const std::filesystem::path& folder);

/// Throws InputError where `path` is one of these files, by whatever name or link: they are read.
void check_not_read(const std::filesystem::path& path,
                    std::span<const std::filesystem::path> files);

/// Removes what processes that were killed while they wrote have left in the folder.
void remove_unfinished(const std::filesystem::path& folder);

/// Several outputs, each of which is tried, whatever becomes of the others.
class Outputs {
  public:
    /// Runs `write`; keeps the sentence of what it throws.
    template <class Write>
    void attempt(Write&& write) {
        try {
            write();
        } catch (const std::exception& error) {
            failures_.emplace_back(error.what());
        }
    }

    bool any_failed() const { return !failures_.empty(); }

    /// Throws one InputError for all that failed.
    void check() const;

  private:
    std::vector<std::string> failures_;
};

} // namespace onde
