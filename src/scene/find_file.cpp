#include "scene/find_file.h"

#include "core/error.h"

#include <algorithm>
#include <cctype>

namespace onde {
namespace fs = std::filesystem;

namespace {

std::string lower(std::string text) {
    std::ranges::transform(text, text.begin(),
                           [](unsigned char c) { return char(std::tolower(c)); });
    return text;
}

std::string with_slashes(std::string name) {
    std::ranges::replace(name, '\\', '/');
    return name;
}

/// The spellings of a name that are worth a try, best first.
std::vector<std::string> spellings(const std::string& name) {
    std::vector<std::string> result{name};
    const std::string slashes = with_slashes(name);
    result.push_back(slashes);
    const size_t comment = slashes.find(" #");
    if (comment != std::string::npos) result.push_back(slashes.substr(0, comment));
    std::string& last = result.back();
    last.erase(last.find_last_not_of(" \t") + 1);
    if (last.size() > 2 && last.front() == '"' && last.back() == '"')
        result.push_back(last.substr(1, last.size() - 2));
    const std::string file = result.back().substr(result.back().find_last_of('/') + 1);
    result.push_back(file);
    return result;
}

/// That part of a path as it is spelled in the folder, or nothing.
std::optional<std::string> spelled_in(const fs::path& folder, const fs::path& part) {
    std::error_code error;
    if (part == "." || part == ".." || fs::exists(folder / part, error)) return part.string();
    const std::string wanted = lower(part.string());
    for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
         entry.increment(error))
        if (lower(entry->path().filename().string()) == wanted)
            return entry->path().filename().string();
    return std::nullopt;
}

/// The reference as a file that exists, whatever its case; nothing when there is none.
std::optional<std::string> existing(const fs::path& folder, const fs::path& reference) {
    fs::path found;
    for (const fs::path& part : reference) {
        const auto spelled = spelled_in(folder / found, part);
        if (!spelled) return std::nullopt;
        found /= *spelled;
    }
    std::error_code error;
    if (!fs::is_regular_file(folder / found, error)) return std::nullopt;
    return found.string();
}

} // namespace

bool FileFinder::may_use(const std::string& name) const {
    try {
        context_.resolve(folder_, with_slashes(name), "");
        return true;
    } catch (const InputError&) {
        return false;
    }
}

std::optional<std::string> FileFinder::search(const std::string& name,
                                              const std::string& beside) const {
    for (const std::string& spelling : spellings(name))
        for (const std::string& in : {beside, std::string(".")}) {
            const std::string reference = (fs::path(in) / spelling).lexically_normal().string();
            if (spelling.empty() || !may_use(reference)) continue;
            const auto found = existing(folder_, reference);
            if (found && may_use(*found)) return found;
        }
    return std::nullopt;
}

std::optional<std::string> FileFinder::find(const std::string& name, const std::string& beside) {
    constexpr size_t MAX_NAME = 4096;  // what Linux opens
    constexpr size_t MAX_NAMES = 4096; // each costs tens of microseconds, found or not
    if (name.empty() || name.size() > MAX_NAME) return std::nullopt;
    if (const auto known = known_.find({name, beside}); known != known_.end()) return known->second;
    if (known_.size() == MAX_NAMES) return std::nullopt;
    return known_[{name, beside}] = search(name, beside);
}

} // namespace onde
