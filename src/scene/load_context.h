// What one load shares from its first file to its last: its options and its budget of memory.
#pragma once

#include "scene/load_options.h"
#include "scene/notes.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace onde {

class LoadContext {
  public:
    explicit LoadContext(const LoadOptions& options = {});
    LoadContext(const LoadContext&) = delete;
    LoadContext& operator=(const LoadContext&) = delete;

    const LoadOptions& options() const { return options_; }

    /// Takes `count` things of `size` bytes from what the whole load may use. To be called before
    /// they are allocated. Throws InputError "WHERE: ..." where they are more than is left.
    void spend(uint64_t count, uint64_t size, const std::string& where);

    /// Bytes that are left.
    uint64_t left() const { return left_; }

    /// Notes about that file, which refuse what is wrong if the user asked for that.
    Notes notes_of(const std::filesystem::path& file) const;

    /// As resolve_inside() of references.h, with the root that the user chose.
    std::filesystem::path resolve(const std::filesystem::path& folder, const std::string& reference,
                                  const std::string& where) const;

  private:
    LoadOptions options_;
    uint64_t left_;
};

} // namespace onde
