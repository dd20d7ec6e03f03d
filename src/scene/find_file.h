// Finds files whose names come from other systems: with backslashes, other capitals, quotes, or
// the folders of the machine that wrote them.
#pragma once

#include "scene/load_context.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace onde {

/// Looks for the files that one scene file names.
class FileFinder {
  public:
    /// `folder` is the scene file's.
    FileFinder(std::filesystem::path folder, LoadContext& context)
        : folder_(std::move(folder)), context_(context) {}

    LoadContext& context() { return context_; }
    const std::filesystem::path& folder() const { return folder_; }

    /// The name, relative to folder(), of the file that `name` stands for: as written, with slashes
    /// for backslashes, without quotes, without a comment that begins with " #", in another
    /// spelling of upper and lower case, and by its last part only; each in `beside`, a folder
    /// within folder(), and in folder() itself. Nothing when there is none that the scene may use.
    std::optional<std::string> find(const std::string& name, const std::string& beside = ".");

    /// Whether the scene may use a file of that name (LoadContext::resolve()).
    bool may_use(const std::string& name) const;

  private:
    std::optional<std::string> search(const std::string& name, const std::string& beside) const;

    std::filesystem::path folder_;
    LoadContext& context_;
    std::map<std::pair<std::string, std::string>, std::optional<std::string>> known_;
};

} // namespace onde
