// Counts the files that a scene includes: a few that include each other many times would be read a
// million times.
#pragma once

#include "core/error.h"

#include <cstdint>
#include <filesystem>

namespace onde {

class InclusionCount {
  public:
    /// Throws InputError where they are too many.
    void add(const std::filesystem::path& file) {
        if (++count_ > MOST)
            throw InputError("{}: more than {} files are included, some of them again and again; "
                             "include each less often, or flatten them",
                             file.string(), MOST);
    }

  private:
    static constexpr uint32_t MOST = 16384;

    uint32_t count_ = 0;
};

} // namespace onde
