// From the shape that a wide tree describes to the bytes of a narrow layout.
#include "accel/statistics.h"

#include "core/error.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <span>

namespace onde {

using namespace accel;

namespace {

struct Child {
    Box box;
    uint32_t word;

    bool is_leaf() const { return word & BVH_LEAF; }
};

/// Of one node, at most as many as the layout takes.
class Children {
  public:
    explicit Children(const BvhNode& node) {
        for (uint32_t slot = 0; slot < BVH_WIDTH && node.child[slot] != BVH_NONE; ++slot)
            all_[count_++] = {slot_box(node, slot), node.child[slot]};
    }

    uint32_t size() const { return count_; }
    std::span<const Child> all() const { return std::span(all_).first(count_); }
    const Child& operator[](size_t i) const { return all_[i]; }

  private:
    std::array<Child, BVH_WIDTH> all_;
    uint32_t count_ = 0;
};

/// Appends to the slots of the output what a leaf holds; returns how many they are.
uint32_t append_slots(const Bvh& wide, uint32_t word, AlignedVector<BvhSlot>& slots) {
    const uint32_t kind = word & BVH_KIND_MASK, index = word & BVH_INDEX_MASK;
    if (kind != BVH_LEAF_TRIANGLES) {
        slots.push_back({{}, kind, {}, index, {}, 0});
        return 1;
    }
    const TriangleBlock& b = wide.blocks[index];
    uint32_t lane = 0;
    for (; lane < BVH_LEAF_WIDTH && b.primitive[lane] != BVH_NONE; ++lane)
        slots.push_back({{b.v0_x[lane], b.v0_y[lane], b.v0_z[lane]},
                         kind,
                         {b.e1_x[lane], b.e1_y[lane], b.e1_z[lane]},
                         b.primitive[lane],
                         {b.e2_x[lane], b.e2_y[lane], b.e2_z[lane]},
                         0});
    return lane;
}

/// Which slot of a compressed node each child gets: of the pairs that are left, always the one that
/// lies farthest toward its slot's corner (Ylitie et al., section 3.2, where an auction is used).
std::array<uint32_t, COMPRESSED_WIDTH> assign_slots(const Children& children) {
    Box centers;
    for (const Child& child : children.all()) centers.extend(child.box.center());
    const Lanes middle = centers.center();
    float reach[COMPRESSED_WIDTH][COMPRESSED_WIDTH];
    for (uint32_t i = 0; i < children.size(); ++i) {
        const Lanes way = children[i].box.center() - middle;
        for (uint32_t slot = 0; slot < COMPRESSED_WIDTH; ++slot)
            reach[i][slot] = (slot & 1 ? way[0] : -way[0]) + (slot & 2 ? way[1] : -way[1]) +
                             (slot & 4 ? way[2] : -way[2]);
    }
    std::array<uint32_t, COMPRESSED_WIDTH> slot_of;
    uint32_t placed = 0, taken = 0;
    for (uint32_t round = 0; round < children.size(); ++round) {
        float farthest = -std::numeric_limits<float>::infinity();
        uint32_t best = 0, best_slot = 0;
        for (uint32_t i = 0; i < children.size(); ++i)
            for (uint32_t slot = 0; slot < COMPRESSED_WIDTH; ++slot) {
                if (placed >> i & 1 || taken >> slot & 1) continue;
                // Not >, which nothing passes where coordinates overflow.
                if (reach[i][slot] <= farthest) continue;
                farthest = reach[i][slot];
                best = i;
                best_slot = slot;
            }
        placed |= 1u << best;
        taken |= 1u << best_slot;
        slot_of[best] = best_slot;
    }
    return slot_of;
}

/// The planes of one axis of a compressed node.
struct Grid {
    float origin;
    uint8_t exponent; ///< as in a float's bits

    Grid(float low, float high) : origin(low), exponent(1) {
        int power = 0; // 255 steps of 2^power reach across
        std::frexp((double(high) - low) / 255, &power);
        exponent = uint8_t(std::clamp(power + 127, 1, 254));
    }
    double step() const { return std::ldexp(1.0, int(exponent) - 127); }
    uint8_t below(float plane) const {
        return count(std::floor((plane - double(origin)) / step()));
    }
    uint8_t above(float plane) const { return count(std::ceil((plane - double(origin)) / step())); }

  private:
    static uint8_t count(double steps) { return uint8_t(std::clamp(steps, 0.0, 255.0)); }
};

/// Writes trees one below another, each from its root down.
class Compressor {
  public:
    Compressor(const Bvh& wide, Bvh& out) : wide_(wide), out_(out) {}

    uint32_t add_tree(uint32_t root) {
        const auto index = uint32_t(out_.compressed.size());
        out_.compressed.emplace_back();
        write(index, root);
        return index;
    }

  private:
    void write(uint32_t index, uint32_t from) {
        const Children children(wide_.nodes[from]);
        BvhCompressed node{};
        node.child = uint32_t(out_.compressed.size());
        node.slot = uint32_t(out_.slots.size());
        Box box;
        for (const Child& child : children.all()) box.extend(child.box);
        if (box.is_empty()) box = {splat(0.0f), splat(0.0f)};
        const Grid grids[3] = {
            {box.low[0], box.high[0]}, {box.low[1], box.high[1]}, {box.low[2], box.high[2]}};
        for (int axis = 0; axis < 3; ++axis) {
            node.origin[axis] = grids[axis].origin;
            node.exponent[axis] = grids[axis].exponent;
        }
        const auto slot_of = assign_slots(children);
        std::array<uint32_t, COMPRESSED_WIDTH> child_in;
        child_in.fill(BVH_NONE);
        for (uint32_t i = 0; i < children.size(); ++i) child_in[slot_of[i]] = i;
        for (uint32_t slot = 0; slot < COMPRESSED_WIDTH; ++slot) {
            if (child_in[slot] == BVH_NONE) continue;
            const Child& child = children[child_in[slot]];
            set_planes(node, slot, child.box, grids);
            if (child.is_leaf()) {
                const auto first = uint32_t(out_.slots.size()) - node.slot;
                const uint32_t count = append_slots(wide_, child.word, out_.slots);
                node.leaf[slot] = uint8_t(count << 5 | first);
            } else {
                node.inner |= uint8_t(1u << slot);
            }
        }
        out_.compressed.resize(out_.compressed.size() + size_t(std::popcount(node.inner)));
        out_.compressed[index] = node;
        for (uint32_t slot = 0, next = node.child; slot < COMPRESSED_WIDTH; ++slot)
            if (node.inner >> slot & 1) write(next++, children[child_in[slot]].word);
    }

    static void set_planes(BvhCompressed& node, uint32_t slot, const Box& box,
                           const Grid (&grids)[3]) {
        node.low_x[slot] = grids[0].below(box.low[0]);
        node.high_x[slot] = grids[0].above(box.high[0]);
        node.low_y[slot] = grids[1].below(box.low[1]);
        node.high_y[slot] = grids[1].above(box.high[1]);
        node.low_z[slot] = grids[2].below(box.low[2]);
        node.high_z[slot] = grids[2].above(box.high[2]);
    }

    const Bvh& wide_;
    Bvh& out_;
};

/// The same of pairs.
class PairWriter {
  public:
    PairWriter(const Bvh& wide, Bvh& out) : wide_(wide), out_(out) {}

    uint32_t add_tree(uint32_t root) {
        const auto index = uint32_t(out_.pairs.size());
        out_.pairs.emplace_back();
        const Children children(wide_.nodes[root]);
        BvhPair pair{};
        for (uint32_t slot = 0; slot < 2; ++slot) {
            const bool is_there = slot < children.size();
            const Box box = is_there ? children[slot].box : Box{};
            pair.low_x[slot] = box.low[0], pair.high_x[slot] = box.high[0];
            pair.low_y[slot] = box.low[1], pair.high_y[slot] = box.high[1];
            pair.low_z[slot] = box.low[2], pair.high_z[slot] = box.high[2];
            pair.child[slot] = is_there ? add_child(children[slot].word) : BVH_NONE;
        }
        out_.pairs[index] = pair;
        return index;
    }

  private:
    uint32_t add_child(uint32_t word) {
        if (!(word & BVH_LEAF)) return add_tree(word);
        const auto first = uint32_t(out_.slots.size());
        const uint32_t count = append_slots(wide_, word, out_.slots);
        return BVH_LEAF | (count - 1) << BINARY_COUNT_SHIFT | first;
    }

    const Bvh& wide_;
    Bvh& out_;
};

/// Every tree once, the world's first.
template <class Writer>
void write_trees(const Bvh& wide, Bvh& out) {
    Writer writer(wide, out);
    out.root = writer.add_tree(wide.root);
    std::map<uint32_t, uint32_t> roots;
    for (BvhInstance& instance : out.instances) {
        if (instance.root == BVH_NONE) continue;
        const auto [known, is_new] = roots.try_emplace(instance.root, 0u);
        if (is_new) known->second = writer.add_tree(instance.root);
        instance.root = known->second;
    }
}

} // namespace

void compact_bvh(Bvh& bvh, BvhLayout layout) {
    if (layout == BvhLayout::wide) return;
    constexpr uint32_t LIMIT = (1u << BINARY_COUNT_SHIFT) - 1;
    if (bvh.statistics.references + bvh.spheres.size() + bvh.instances.size() > LIMIT)
        throw InputError("the scene's tree has more than {} leaf entries; split it, use fewer "
                         "triangles or --layout wide",
                         LIMIT);
    Bvh wide;
    wide.root = bvh.root;
    wide.nodes = std::move(bvh.nodes);
    wide.blocks = std::move(bvh.blocks);
    bvh.nodes = {};
    bvh.blocks = {};
    bvh.layout = layout;
    if (layout == BvhLayout::compressed) {
        write_trees<Compressor>(wide, bvh);
        // On the way down the rest of a node waits; around an instance, at most three entries more.
        bvh.stack_size = bvh.statistics.depth + 4;
    } else {
        write_trees<PairWriter>(wide, bvh);
    }
}

} // namespace onde
