#include "core/nearest.h"

#include <algorithm>
#include <numeric>
#include <vector>

namespace onde {
namespace {

/// What is longer is no slip of the pen, and costs time.
constexpr size_t LONGEST = 64;

/// Levenshtein's distance: the fewest insertions, removals and replacements from a to b.
size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t(0));
    for (size_t i = 0; i < a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i + 1;
        for (size_t j = 0; j < b.size(); ++j) {
            const size_t replaced = diagonal + (a[i] == b[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

} // namespace

std::string nearest(std::string_view text, std::span<const std::string_view> names) {
    const std::string_view begin = text.substr(0, LONGEST);
    return std::string(*std::ranges::min_element(
        names, {}, [&](std::string_view name) { return edit_distance(begin, name); }));
}

std::string did_you_mean(std::string_view text, std::span<const std::string_view> names) {
    if (names.empty() || text.size() > LONGEST) return {};
    const std::string best = nearest(text, names);
    const bool begins = text.size() > 2 && best.starts_with(text);
    const size_t slips = text.size() < 4 ? 1 : std::max<size_t>(2, text.size() / 3);
    if (!begins && edit_distance(text, best) > slips) return {};
    return "; did you mean " + best + "?";
}

} // namespace onde
