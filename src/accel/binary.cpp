#include "accel/binary.h"

#include "accel/parallel.h"
#include "accel/split.h"

#include <algorithm>

namespace onde::accel {

namespace {

class BinaryBuilder {
  public:
    BinaryBuilder(BinaryTree& tree, std::span<Reference> references, const BvhOptions& options)
        : tree_(tree), references_(references), max_bins_(std::clamp(options.bins, 2u, MAX_BINS)),
          leaf_triangles_(shape_of(options.layout).leaf_triangles), parallel_(options.parallel) {}

    void build() {
        const auto count = uint32_t(references_.size());
        Extent extent;
        fold_ranges(extent, count, parallel_, [&](Extent& part, size_t begin, size_t end) {
            for (size_t i = begin; i < end; ++i) part.extend(references_[i].box());
        });
        tree_.nodes.grow_by(1);
        build_node(0, 0, count, extent);
    }

  private:
    void build_node(uint32_t node, uint32_t begin, uint32_t count, const Extent& extent) {
        const auto references = references_.subspan(begin, count);
        if (fits_leaf(references)) {
            tree_.nodes[node] = {extent.box.low, extent.box.high, 0, begin, count, 0};
            return;
        }
        Extent sides[2];
        const uint32_t left = divide(references, extent, sides);
        const uint32_t child = tree_.add_children();
        tree_.nodes[node] = {extent.box.low, extent.box.high, child, begin, count, 0};
        run_both(
            parallel_ && count > TASK_SIZE, [&] { build_node(child, begin, left, sides[0]); },
            [&] { build_node(child + 1, begin + left, count - left, sides[1]); });
    }

    bool fits_leaf(std::span<const Reference> references) const {
        if (references.size() == 1) return true;
        return references.size() <= leaf_triangles_ &&
               std::ranges::none_of(references, &Reference::is_single);
    }

    uint32_t divide(std::span<Reference> references, const Extent& extent, Extent (&sides)[2]) {
        // Few references can't tell many bins apart, and clearing and sweeping bins costs time.
        const uint32_t bins = std::min<uint32_t>(max_bins_, 4 + uint32_t(references.size()) / 4);
        const BinGrid grid(extent.centers, bins);
        const Split split = find_split(references, grid, parallel_);
        return split.axis < 0 ? partition_evenly(references, sides)
                              : partition(references, grid, split, sides);
    }

    static constexpr uint32_t TASK_SIZE = 1024;

    BinaryTree& tree_;
    std::span<Reference> references_;
    uint32_t max_bins_, leaf_triangles_;
    bool parallel_;
};

} // namespace

BinaryTree build_binary(std::vector<Reference> references, const BvhOptions& options) {
    BinaryTree tree;
    if (references.empty()) return tree;
    BinaryBuilder(tree, references, options).build();
    tree.keep_origins(references);
    return tree;
}

} // namespace onde::accel
