#include "accel/plain.h"

#include "accel/plain_builder.h"
#include "accel/split.h"

#include <algorithm>

namespace onde::accel {

namespace {

Box bounds(std::span<const Reference> references) {
    Box box;
    for (const Reference& reference : references) box.extend(reference.box());
    return box;
}

void build_half(PlainBuilder& builder, uint32_t node, std::span<Reference> references) {
    if (references.size() == 1) return builder.set_leaf(node, references, bounds(references));
    Extent sides[2];
    const uint32_t left = partition_evenly(references, sides);
    const uint32_t child = builder.set_inner(node, uint32_t(references.size()), bounds(references));
    build_half(builder, child, references.first(left));
    build_half(builder, child + 1, references.subspan(left));
}

/// Finite, and with a surface that is: beyond any scene.
Box everywhere() {
    constexpr float FAR = 1e15f;
    return {splat(-FAR), splat(FAR)};
}

/// The leaves are runs of references; `ends` are where they end.
void build_runs(PlainBuilder& builder, uint32_t node, std::span<const Reference> references,
                std::span<const uint32_t> ends, uint32_t begin) {
    if (ends.size() == 1)
        return builder.set_leaf(node, references.subspan(begin, ends[0] - begin), everywhere());
    const size_t half = ends.size() / 2;
    const uint32_t child = builder.set_inner(node, ends.back() - begin, everywhere());
    build_runs(builder, child, references, ends.first(half), begin);
    build_runs(builder, child + 1, references, ends.subspan(half), ends[half - 1]);
}

std::vector<uint32_t> leaf_ends(std::span<const Reference> references, uint32_t leaf_triangles) {
    std::vector<uint32_t> ends;
    uint32_t filled = 0;
    for (uint32_t i = 0; i < references.size(); ++i) {
        const bool single = references[i].is_single();
        const bool new_leaf = filled == 0 || single || filled == leaf_triangles;
        if (new_leaf && i > 0) ends.push_back(i);
        filled = single ? leaf_triangles : new_leaf ? 1 : filled + 1;
    }
    ends.push_back(uint32_t(references.size()));
    return ends;
}

} // namespace

BinaryTree build_median(std::vector<Reference> references) {
    if (references.empty()) return {};
    PlainBuilder builder;
    build_half(builder, 0, references);
    return builder.take();
}

BinaryTree build_list(std::vector<Reference> references, uint32_t leaf_triangles) {
    if (references.empty()) return {};
    PlainBuilder builder;
    build_runs(builder, 0, references, leaf_ends(references, leaf_triangles), 0);
    return builder.take();
}

} // namespace onde::accel
