// Nodes of the tree in which a film's samples are joined; see render/film.h. A set of blocks that
// follow each other has one cover by whole nodes, as few as can be: what a film keeps, and what
// files of it hold.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace onde {

/// Samples of a pixel that are added one by one, in their order.
inline constexpr uint32_t FILM_BLOCK = 64;

/// The blocks index << level to ((index + 1) << level) - 1.
struct FilmNode {
    uint32_t level = 0, index = 0;

    uint64_t first_block() const { return uint64_t(index) << level; }
    uint64_t end_block() const { return (uint64_t(index) + 1) << level; }
    bool is_right() const { return index % 2 != 0; }
    /// The one that is joined with it.
    FilmNode sibling() const { return {level, index ^ 1}; }
    FilmNode parent() const { return {level + 1, index / 2}; }

    bool operator==(const FilmNode&) const = default;
};

/// The cover of the blocks begin to end - 1 by whole nodes, in their order.
std::vector<FilmNode> cover(uint32_t begin, uint32_t end);

/// The sum over some of a tree's nodes, joined as the tree says with the missing ones left out.
/// `nodes` are disjoint and in their order, and there is at least one; `load(i)` makes the sums of
/// nodes[i], and `add(a, b)` adds those of b to a. At most `level` of the highest node that joins
/// them, and one, are held at a time.
template <class Load, class Add>
auto join_nodes(std::span<const FilmNode> nodes, const Load& load, const Add& add) {
    constexpr uint32_t ROOT = 32;
    const auto join = [&](const auto& self, FilmNode root, size_t first,
                          size_t end) -> decltype(load(first)) {
        if (end - first == 1) return load(first);
        const FilmNode left{root.level - 1, 2 * root.index}, right = left.sibling();
        size_t middle = first;
        while (middle < end && nodes[middle].first_block() < right.first_block()) ++middle;
        if (middle == end) return self(self, left, first, end);
        if (middle == first) return self(self, right, first, end);
        auto sums = self(self, right, middle, end);
        add(sums, self(self, left, first, middle));
        return sums;
    };
    return join(join, FilmNode{ROOT, 0}, 0, nodes.size());
}

} // namespace onde
