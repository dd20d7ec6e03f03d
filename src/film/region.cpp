#include "film/region.h"

#include <algorithm>

namespace onde {
namespace {

/// Where the spans begin and end, in turn.
template <class Spans>
std::vector<uint32_t> borders_of(const Spans& spans) {
    std::vector<uint32_t> borders;
    for (const auto& [begin, end] : spans) {
        borders.push_back(begin);
        borders.push_back(end);
    }
    return borders;
}

} // namespace

Region::Region(const Rectangle& r) {
    if (r.pixels() > 0) bands_.push_back({r.y, r.end_y(), {{r.x, r.end_x()}}});
}

Region::Region(std::span<const Rectangle> rectangles) {
    if (rectangles.size() > 1) {
        const size_t half = rectangles.size() / 2;
        *this = Region(rectangles.first(half)) | Region(rectangles.subspan(half));
    } else if (!rectangles.empty()) {
        *this = Region(rectangles.front());
    }
}

std::vector<Rectangle> Region::rectangles() const {
    std::vector<Rectangle> all;
    for (const Band& band : bands_)
        for (const auto& [begin, end] : band.spans)
            all.push_back({begin, band.begin, end - begin, band.end - band.begin});
    return all;
}

void Region::add(Band band) {
    if (band.spans.empty()) return;
    if (!bands_.empty() && bands_.back().end == band.begin && bands_.back().spans == band.spans)
        bands_.back().end = band.end;
    else
        bands_.push_back(std::move(band));
}

template <class Keep>
Region Region::combine(const Region& a, const Region& b, Keep keep) {
    std::vector<uint32_t> rows;
    for (const Region* region : {&a, &b})
        for (const Band& band : region->bands_) {
            rows.push_back(band.begin);
            rows.push_back(band.end);
        }
    std::ranges::sort(rows);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());

    Region result;
    auto band_a = a.bands_.begin(), band_b = b.bands_.begin();
    for (size_t i = 0; i + 1 < rows.size(); i++) {
        const auto borders_at = [row = rows[i]](const Region& region, auto& band) {
            while (band != region.bands_.end() && band->end <= row) ++band;
            const bool there = band != region.bands_.end() && band->begin <= row;
            return there ? borders_of(band->spans) : std::vector<uint32_t>();
        };
        const std::vector<uint32_t> in_a = borders_at(a, band_a), in_b = borders_at(b, band_b);
        Band band{rows[i], rows[i + 1], {}};
        bool inside = false;
        for (size_t at_a = 0, at_b = 0; at_a < in_a.size() || at_b < in_b.size();) {
            const uint32_t x = std::min(at_a < in_a.size() ? in_a[at_a] : UINT32_MAX,
                                        at_b < in_b.size() ? in_b[at_b] : UINT32_MAX);
            at_a += at_a < in_a.size() && in_a[at_a] == x;
            at_b += at_b < in_b.size() && in_b[at_b] == x;
            const bool kept = keep(at_a % 2 != 0, at_b % 2 != 0);
            if (kept == inside) continue;
            inside = kept;
            if (kept)
                band.spans.emplace_back(x, x);
            else
                band.spans.back().second = x;
        }
        result.add(std::move(band));
    }
    return result;
}

Region operator|(const Region& a, const Region& b) {
    return Region::combine(a, b, [](bool in_a, bool in_b) { return in_a || in_b; });
}

Region operator&(const Region& a, const Region& b) {
    return Region::combine(a, b, [](bool in_a, bool in_b) { return in_a && in_b; });
}

Region operator-(const Region& a, const Region& b) {
    return Region::combine(a, b, [](bool in_a, bool in_b) { return in_a && !in_b; });
}

Rectangle tile_of(const Rectangle& whole, uint32_t columns, uint32_t rows, uint32_t tile) {
    const auto border = [](uint32_t size, uint32_t i, uint32_t count) {
        return uint32_t(uint64_t(size) * i / count);
    };
    const uint32_t column = tile % columns, row = tile / columns;
    const uint32_t x = border(whole.width, column, columns);
    const uint32_t y = border(whole.height, row, rows);
    return {whole.x + x, whole.y + y, border(whole.width, column + 1, columns) - x,
            border(whole.height, row + 1, rows) - y};
}

} // namespace onde
