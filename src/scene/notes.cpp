#include "scene/notes.h"

#include "core/error.h"
#include "core/shown.h"
#include "core/text.h"

#include <fmt/format.h>

namespace onde {

void Notes::add(const std::string& sentence, const std::string& example) {
    const auto [found, is_new] = index_.try_emplace(sentence, entries_.size());
    if (is_new) entries_.push_back({printable(sentence), shown(example), 0});
    ++entries_[found->second].count;
}

void Notes::wrong(const std::string& sentence, const std::string& example) {
    if (strict_)
        throw InputError("{}: {}{}; --strict refuses that", file_,
                         example.empty() ? "" : shown(example) + ": ", sentence);
    add(sentence, example);
}

std::vector<std::string> Notes::sentences() const {
    std::vector<std::string> result;
    for (const Entry& entry : entries_) {
        std::string detail = entry.example;
        if (entry.count > 1) detail += fmt::format(" and {} more", entry.count - 1);
        if (entry.example.empty())
            detail = entry.count > 1 ? fmt::format("{} times", entry.count) : "";
        result.push_back(detail.empty() ? entry.sentence + "."
                                        : fmt::format("{} ({}).", entry.sentence, detail));
    }
    return result;
}

} // namespace onde
