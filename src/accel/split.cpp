#include "accel/split.h"

#include "accel/parallel.h"

#include <algorithm>
#include <tuple>

namespace onde::accel {

namespace {

struct Bins {
    uint32_t used;
    uint32_t count[3][MAX_BINS];
    Box box[3][MAX_BINS];

    explicit Bins(uint32_t bins) : used(bins) {
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(count[axis], used, 0u);
            std::fill_n(box[axis], used, Box{});
        }
    }

    void add(const Reference& reference, const BinGrid& grid) {
        const Box bounds = reference.box();
        const IntLanes bin = grid.bin(bounds.center());
        for (int axis = 0; axis < 3; ++axis) {
            ++count[axis][bin[axis]];
            box[axis][bin[axis]].extend(bounds);
        }
    }
    void merge(const Bins& other) {
        for (int axis = 0; axis < 3; ++axis)
            for (uint32_t i = 0; i < used; ++i) {
                count[axis][i] += other.count[axis][i];
                box[axis][i].extend(other.box[axis][i]);
            }
    }
};

/// Smaller is better; the second member prefers even cuts among equal costs.
struct Cost {
    float area = std::numeric_limits<float>::infinity();
    uint32_t unevenness = ~0u;
    bool operator<(const Cost& other) const {
        return std::tie(area, unevenness) < std::tie(other.area, other.unevenness);
    }
};

/// Improves on `best` along one axis.
void sweep(const Bins& bins, int axis, Split& split, Cost& best) {
    Box rights[MAX_BINS];
    Box right;
    for (uint32_t i = bins.used; i-- > 1;) {
        right.extend(bins.box[axis][i]);
        rights[i] = right;
    }
    uint32_t total = 0;
    for (uint32_t i = 0; i < bins.used; ++i) total += bins.count[axis][i];

    Box left;
    uint32_t count = 0;
    for (uint32_t i = 1; i < bins.used; ++i) {
        left.extend(bins.box[axis][i - 1]);
        count += bins.count[axis][i - 1];
        if (count == 0 || count == total) continue;
        const uint32_t rest = total - count;
        const Cost cost = {half_area(left) * split_weight(count) +
                               half_area(rights[i]) * split_weight(rest),
                           std::max(count, rest)};
        if (cost < best) {
            best = cost;
            split = {axis, i, cost.area, {left, rights[i]}};
        }
    }
}

} // namespace

BinGrid::BinGrid(const Box& centers, uint32_t bins) : bins_(bins), origin_(centers.low) {
    const Lanes size = centers.high - centers.low;
    // Just below `bins`, so that rounding never makes a bin out of range; an axis without a usable
    // extent falls into bin 0 altogether.
    for (int axis = 0; axis < 4; ++axis) {
        const bool usable = size[axis] > std::numeric_limits<float>::min() * 64.0f;
        scale_[axis] = usable ? float(bins) * 0.99999f / size[axis] : 0.0f;
    }
}

Split find_split(std::span<const Reference> references, const BinGrid& grid, bool parallel) {
    Bins bins(grid.bins());
    fold_ranges(bins, references.size(), parallel, [&](Bins& part, size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) part.add(references[i], grid);
    });
    Split split;
    Cost best;
    for (int axis = 0; axis < 3; ++axis) sweep(bins, axis, split, best);
    return split;
}

uint32_t partition(std::span<Reference> references, const BinGrid& grid, const Split& split,
                   Extent (&sides)[2]) {
    const auto goes_left = [&](const Box& box) {
        return uint32_t(grid.bin(box.center())[split.axis]) < split.bin;
    };
    size_t left = 0, right = references.size();
    while (left < right) {
        const Box box = references[left].box();
        if (goes_left(box)) {
            sides[0].extend(box);
            ++left;
        } else {
            sides[1].extend(box);
            std::swap(references[left], references[--right]);
        }
    }
    return uint32_t(left);
}

uint32_t partition_evenly(std::span<Reference> references, Extent (&sides)[2]) {
    Box centers;
    for (const Reference& reference : references) centers.extend(reference.box().center());
    const Lanes size = centers.high - centers.low;
    const int axis =
        size[0] >= size[1] ? (size[0] >= size[2] ? 0 : 2) : (size[1] >= size[2] ? 1 : 2);

    const auto key = [axis](const Reference& reference) {
        return std::tuple(float(reference.box().center()[axis]), reference.owner(),
                          reference.index());
    };
    const size_t half = references.size() / 2;
    std::nth_element(references.begin(), references.begin() + std::ptrdiff_t(half),
                     references.end(),
                     [&](const auto& a, const auto& b) { return key(a) < key(b); });
    for (size_t i = 0; i < references.size(); ++i) sides[i >= half].extend(references[i].box());
    return uint32_t(half);
}

} // namespace onde::accel
