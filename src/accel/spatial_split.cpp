#include "accel/spatial_split.h"

#include "accel/parallel.h"

#include <algorithm>

namespace onde::accel {

namespace {

constexpr uint32_t MOST = SpatialGrid::MOST_BINS;

/// What a split that takes all the room must save, as part of the cost: near the root many
/// triangles could be cut for little, and nothing would be left for where it matters.
constexpr float CUT_PRICE = 0.2f;

struct SpatialBins {
    uint32_t used;
    uint32_t first[3][MOST], last[3][MOST]; ///< references that begin and end in a bin
    Box box[3][MOST];

    explicit SpatialBins(uint32_t bins) : used(bins) {
        for (int axis = 0; axis < 3; ++axis) {
            std::fill_n(first[axis], used, 0u);
            std::fill_n(last[axis], used, 0u);
            std::fill_n(box[axis], used, Box{});
        }
    }

    void add(const Reference& reference, std::span<const Geometry> geometries,
             const SpatialGrid& grid) {
        const SpatialGrid::Range range = grid.range(reference);
        const Box bounds = reference.box();
        for (int axis = 0; axis < 3; ++axis) {
            const int from = range.first[axis], to = range.last[axis];
            ++first[axis][from];
            ++last[axis][to];
            if (from == to)
                box[axis][from].extend(bounds);
            else
                add_parts(corners_of(geometries, reference), bounds, grid, axis, from, to);
        }
    }

    void merge(const SpatialBins& other) {
        for (int axis = 0; axis < 3; ++axis)
            for (uint32_t i = 0; i < used; ++i) {
                first[axis][i] += other.first[axis][i];
                last[axis][i] += other.last[axis][i];
                box[axis][i].extend(other.box[axis][i]);
            }
    }

  private:
    void add_parts(const Corners& corners, Box rest, const SpatialGrid& grid, int axis, int from,
                   int to) {
        for (int bin = from; bin < to; ++bin) {
            const Halves halves = halve(corners, rest, axis, grid.plane(axis, uint32_t(bin + 1)));
            if (halves.below.has_points()) box[axis][bin].extend(halves.below);
            rest = halves.above;
        }
        if (rest.has_points()) box[axis][to].extend(rest);
    }
};

/// Improves on `best` along one axis.
void sweep(const SpatialBins& bins, int axis, uint32_t count, uint32_t most_cuts,
           SpatialSplit& best) {
    Box rights[MOST];
    Box right;
    for (uint32_t i = bins.used; i-- > 1;) {
        right.extend(bins.box[axis][i]);
        rights[i] = right;
    }
    Box left;
    uint32_t begun = 0, ended = 0;
    for (uint32_t i = 1; i < bins.used; ++i) {
        left.extend(bins.box[axis][i - 1]);
        begun += bins.first[axis][i - 1];
        ended += bins.last[axis][i - 1];
        const uint32_t rest = count - ended;
        if (begun == 0 || rest == 0 || begun - ended > most_cuts) continue;
        const float price = 1.0f + CUT_PRICE * float(begun - ended) / float(most_cuts);
        const float cost = price * (half_area(left) * split_weight(begun) +
                                    half_area(rights[i]) * split_weight(rest));
        if (cost < best.cost) best = {axis, i, cost, {begun, rest}, {left, rights[i]}};
    }
}

/// What becomes of a reference that lies across a split.
enum class Fate { left, right, both };

/// By the areas that the sides have when all are cut; so that the order doesn't matter.
class Unsplitter {
  public:
    explicit Unsplitter(const SpatialSplit& split) : split_(split) {
        for (int side = 0; side < 2; ++side) {
            count_[side] = float(split.counts[side]);
            area_[side] = half_area(split.sides[side]);
        }
    }

    Fate decide(const Box& box) const {
        const float both = area_[0] * count_[0] + area_[1] * count_[1];
        const float left = grown(0, box) * count_[0] + area_[1] * (count_[1] - 1.0f);
        const float right = area_[0] * (count_[0] - 1.0f) + grown(1, box) * count_[1];
        if (both <= left && both <= right) return Fate::both;
        return left <= right ? Fate::left : Fate::right;
    }

  private:
    float grown(int side, Box box) const {
        box.extend(split_.sides[side]);
        return half_area(box);
    }

    const SpatialSplit& split_;
    float count_[2], area_[2];
};

} // namespace

SpatialGrid::SpatialGrid(const Box& box, uint32_t bins)
    : bins_(bins), origin_(box.low), size_((box.high - box.low) * splat(1.0f / float(bins))) {
    for (int axis = 0; axis < 4; ++axis) {
        const bool usable = size_[axis] > std::numeric_limits<float>::min() * 64.0f;
        scale_[axis] = usable ? 1.0f / size_[axis] : 0.0f;
    }
}

SpatialSplit find_spatial_split(std::span<const Reference> references,
                                std::span<const Geometry> geometries, const SpatialGrid& grid,
                                uint32_t most_cuts, bool parallel) {
    SpatialBins bins(grid.bins());
    fold_ranges(bins, references.size(), parallel,
                [&](SpatialBins& part, size_t begin, size_t end) {
                    for (size_t i = begin; i < end; ++i) part.add(references[i], geometries, grid);
                });
    SpatialSplit split;
    for (int axis = 0; axis < 3; ++axis)
        sweep(bins, axis, uint32_t(references.size()), most_cuts, split);
    return split;
}

SpatialSides partition_spatially(Reference* first, uint32_t count,
                                 std::span<const Geometry> geometries, const SpatialGrid& grid,
                                 const SpatialSplit& split) {
    const Unsplitter unsplitter(split);
    const float at = grid.plane(split.axis, split.bin);
    const int bin = int(split.bin);
    SpatialSides sides{};
    uint32_t left = 0, right = count, end = count;
    const auto keep_left = [&](const Reference& reference) {
        sides.extents[0].extend(reference.box());
        first[left++] = reference;
    };
    const auto move_right = [&](const Reference& reference) {
        sides.extents[1].extend(reference.box());
        std::swap(first[left], first[--right]);
    };
    while (left < right) {
        const Reference reference = first[left];
        const SpatialGrid::Range range = grid.range(reference);
        if (range.last[split.axis] < bin) {
            keep_left(reference);
            continue;
        }
        if (range.first[split.axis] >= bin) {
            move_right(reference);
            continue;
        }
        const Fate fate = unsplitter.decide(reference.box());
        const Halves halves =
            fate == Fate::both ? cut(geometries, reference, split.axis, at) : Halves{};
        if (fate == Fate::left || (fate == Fate::both && !halves.above.has_points())) {
            keep_left(reference);
        } else if (fate == Fate::right || !halves.below.has_points()) {
            move_right(reference);
        } else {
            const Reference part(halves.above, reference.owner(), reference.index());
            sides.extents[1].extend(part.box());
            first[end++] = part;
            keep_left({halves.below, reference.owner(), reference.index()});
        }
    }
    sides.counts[0] = left;
    sides.counts[1] = end - left;
    return sides;
}

} // namespace onde::accel
