#include "film/ledger.h"

#include "film/region.h"

#include <algorithm>
#include <map>
#include <set>

namespace onde {
namespace {

/// By level and index.
using Nodes = std::map<std::pair<uint32_t, uint32_t>, Region>;

/// Puts a region of pixels that have both halves into the parent, from the lowest level up.
void join(Nodes& nodes) {
    for (auto at = nodes.begin(); at != nodes.end(); ++at) {
        const FilmNode node{at->first.first, at->first.second};
        if (!node.is_right()) continue;
        const auto left = nodes.find({node.level, node.sibling().index});
        if (left == nodes.end()) continue;
        const Region both = left->second & at->second;
        if (both.empty()) continue;
        left->second = left->second - both;
        at->second = at->second - both;
        Region& parent = nodes[{node.level + 1, node.parent().index}]; // comes behind
        parent = parent | both;
    }
}

auto order_of(const FilmRange& r) {
    return std::tuple{r.first, r.count, r.window.y, r.window.x};
}

bool have_common(const Rectangle& a, const Rectangle& b) {
    return a.x < b.end_x() && b.x < a.end_x() && a.y < b.end_y() && b.y < a.end_y();
}

uint64_t end_of(const FilmRange& range) {
    return range.end() + range.pass;
}

} // namespace

std::vector<FilmRange> join_ranges(std::span<const FilmRange> ranges) {
    std::map<std::pair<uint32_t, uint32_t>, std::vector<Rectangle>> whole, beginnings;
    for (const FilmRange& range : ranges)
        if (const auto node = range.node())
            whole[{node->level, node->index}].push_back(range.window);
        else
            beginnings[{range.first, range.count}].push_back(range.window);
    Nodes nodes;
    for (const auto& [node, windows] : whole) nodes[node] = Region(windows);
    join(nodes);

    std::vector<FilmRange> joined;
    for (const auto& [node, region] : nodes)
        for (const Rectangle& window : region.rectangles())
            joined.push_back(range_of({node.first, node.second}, window));
    for (const auto& [samples, windows] : beginnings)
        for (const Rectangle& window : Region(windows).rectangles())
            joined.push_back({.window = window, .first = samples.first, .count = samples.second});
    std::ranges::sort(joined, {}, order_of);
    return joined;
}

std::vector<FilmRange> missing_ranges(std::span<const FilmRange> ranges, const FilmHeader& header) {
    if (header.identity.noise > 0) return {};
    const uint32_t samples = header.samples;
    std::set<uint64_t> borders{0, samples};
    for (const FilmRange& range : ranges)
        for (const uint64_t border : {uint64_t(range.first), range.end()})
            if (border < samples) borders.insert(border);
    const Region picture(Rectangle{0, 0, header.identity.width, header.identity.height});
    std::vector<FilmRange> missing;
    Region before; // what the samples before the border lack
    size_t of_before = 0;
    for (auto begin = borders.begin(), end = std::next(begin); end != borders.end();
         ++begin, ++end) {
        std::vector<Rectangle> there;
        for (const FilmRange& range : ranges)
            if (range.first <= *begin && range.end() >= *end) there.push_back(range.window);
        const Region lacks = picture - Region(there);
        const auto count = uint32_t(*end - *begin);
        if (lacks == before) {
            for (size_t i = of_before; i < missing.size(); i++) missing[i].count += count;
            continue;
        }
        before = lacks;
        of_before = missing.size();
        for (const Rectangle& window : lacks.rectangles())
            missing.push_back({.window = window, .first = uint32_t(*begin), .count = count});
    }
    return missing;
}

std::optional<std::pair<size_t, size_t>> find_overlap(std::span<const FilmRange> ranges) {
    std::vector<size_t> order(ranges.size());
    for (size_t i = 0; i < order.size(); i++) order[i] = i;
    std::ranges::sort(order, {}, [&](size_t i) { return ranges[i].first; });
    for (size_t i = 0; i < order.size(); i++)
        for (size_t j = i + 1; j < order.size(); j++) {
            const FilmRange &a = ranges[order[i]], &b = ranges[order[j]];
            if (b.first >= end_of(a)) break;
            if (have_common(a.window, b.window)) return std::minmax(order[i], order[j]);
        }
    return std::nullopt;
}

} // namespace onde
