// What one load shares from its first file to its last: its options and its budget of memory.
#pragma once

#include "core/error.h"
#include "image/image.h"
#include "scene/load_options.h"
#include "scene/notes.h"

#include <cstdint>
#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace onde {

/// More memory is wanted than the load may use: it ends, as it would at each of a thousand parts.
class OverBudget : public InputError {
    using InputError::InputError;
};

class LoadContext {
  public:
    explicit LoadContext(const LoadOptions& options = {});
    LoadContext(const LoadContext&) = delete;
    LoadContext& operator=(const LoadContext&) = delete;

    const LoadOptions& options() const { return options_; }

    /// Takes `count` things of `size` bytes from what the whole load may use. To be called before
    /// they are allocated. Throws OverBudget "WHERE: ..." where they are more than is left.
    void spend(uint64_t count, uint64_t size, const std::string& where);

    /// That some file of the load has an animation.
    void found_animation() { is_animated_ = true; }
    bool is_animated() const { return is_animated_; }

    /// Bytes that are left.
    uint64_t left() const { return left_; }

    /// Notes about that file, which refuse what is wrong if the user asked for that.
    Notes notes_of(const std::filesystem::path& file) const;

    /// As resolve_inside() of references.h, with the root that the user chose.
    std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& reference,
                                  const std::string& where);

    /// What has been resolved so far: the files that the scene is read from, or may be.
    std::vector<std::filesystem::path> files() const { return {files_.begin(), files_.end()}; }

  private:
    LoadOptions options_;
    uint64_t left_;
    std::set<std::filesystem::path> files_;
    bool is_animated_ = false;
};

/// Decodes an image that a scene file names, once its pixels are spent by what its header claims.
/// Throws InputError as decode_texels() does, and OverBudget.
TexelImage decode_within(LoadContext& context, std::span<const uint8_t> file,
                         const std::string& name);

/// The file's bytes, which are spent before they are read. Throws InputError as read_file() does.
std::string read_file_within(LoadContext& context, const std::filesystem::path& path,
                             uint64_t limit = uint64_t(4) << 30);

/// Spends in steps of a megabyte what grows bit by bit.
class GradualSpending {
  public:
    /// Both must outlive it.
    GradualSpending(LoadContext& context, const std::string& where)
        : context_(context), where_(where) {}

    void add(uint64_t bytes) {
        owed_ += bytes;
        if (owed_ < STEP) return;
        context_.spend(owed_, 1, where_);
        owed_ = 0;
    }

  private:
    static constexpr uint64_t STEP = uint64_t(1) << 20;

    LoadContext& context_;
    const std::string& where_;
    uint64_t owed_ = 0;
};

} // namespace onde
