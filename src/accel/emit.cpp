// Writes wide trees as the kernels read them.
#include "accel/parallel.h"
#include "accel/records.h"
#include "accel/wide.h"

#include <algorithm>

namespace onde::accel {

class Emitter {
  public:
    Emitter(const WideTree& wide, std::span<const Geometry> geometries, Bvh& out)
        : wide_(wide), tree_(wide.collapse_.tree()), geometries_(geometries), out_(out) {}

    uint32_t emit_root(WidePlace place) const {
        if (tree_.is_empty())
            out_.nodes[place.node] = empty_node();
        else if (!tree_.nodes[0].is_leaf())
            emit_node(0, place);
        else if (wide_.root_is_node_)
            emit_only_leaf(place);
        else
            return emit_leaf(tree_.nodes[0], place);
        return place.node;
    }

  private:
    /// A node above the leaf that is the whole tree.
    void emit_only_leaf(WidePlace place) const {
        BvhNode& node = out_.nodes[place.node++] = empty_node();
        set_slot(node, 0, padded(tree_.nodes[0].box()), emit_leaf(tree_.nodes[0], place));
    }

    /// Preorder: a node's own leaves lie side by side, then come its inner children one by one.
    void emit_node(uint32_t index, WidePlace place) const {
        const ChildList children = wide_.collapse_.children(index);
        BvhNode node = empty_node();
        WidePlace next = place;
        next.node += 1;
        uint32_t slot = 0;
        for (uint32_t child : children) {
            const BinaryNode& leaf = tree_.nodes[child];
            if (leaf.is_leaf()) set_slot(node, slot, padded(leaf.box()), emit_leaf(leaf, next));
            ++slot;
        }
        WidePlace places[BVH_WIDTH];
        for (slot = 0; slot < children.count; ++slot) {
            const BinaryNode& inner = tree_.nodes[children.node[slot]];
            if (inner.is_leaf()) continue;
            set_slot(node, slot, padded(inner.box()), next.node);
            places[slot] = next;
            next.advance(wide_.sizes_[children.node[slot]]);
        }
        out_.nodes[place.node] = node;

        constexpr uint32_t TASK_SIZE = 16384;
        const bool parallel = wide_.parallel_ && tree_.nodes[index].count > TASK_SIZE;
        for_each_child(children.count, parallel, [&](size_t i) {
            if (!tree_.nodes[children.node[i]].is_leaf()) emit_node(children.node[i], places[i]);
        });
    }

    /// Returns the leaf's child word and moves `place` past what it wrote.
    uint32_t emit_leaf(const BinaryNode& leaf, WidePlace& place) const {
        const Origin first = tree_.origins[leaf.begin];
        if (!first.is_single()) {
            emit_block(leaf, out_.blocks[place.block]);
            return BVH_LEAF_TRIANGLES | place.block++;
        }
        if (first.owner == Origin::INSTANCE) return BVH_LEAF_INSTANCE | first.index;
        const bool is_shape = emit_single(first, out_.spheres[place.sphere]);
        return (is_shape ? BVH_LEAF_SHAPE : BVH_LEAF_SPHERE) | place.sphere++;
    }

    void emit_block(const BinaryNode& leaf, TriangleBlock& block) const {
        Origin members[BVH_LEAF_WIDTH];
        for (uint32_t i = 0; i < leaf.count; ++i) {
            const Origin added = tree_.origins[leaf.begin + i];
            uint32_t lane = i;
            for (; lane > 0 && primitive(added) < primitive(members[lane - 1]); --lane)
                members[lane] = members[lane - 1];
            members[lane] = added;
        }
        block = {};
        std::fill_n(block.primitive, BVH_LEAF_WIDTH, BVH_NONE);
        for (uint32_t lane = 0; lane < leaf.count; ++lane)
            set_triangle(block, lane, geometries_[members[lane].owner], members[lane].index,
                         out_.watertight);
    }

    /// Whether it is a shape, else a sphere.
    bool emit_single(Origin origin, BvhSphere& out) const {
        const Geometry& geometry = geometries_[origin.owner & ~Origin::SINGLE];
        const uint32_t id = geometry.first_primitive + origin.index;
        const size_t sphere = origin.index - geometry.triangles.size();
        if (sphere >= geometry.spheres.size()) {
            const ShapeInput& shape = geometry.shapes[sphere - geometry.spheres.size()];
            out = {{}, shape.minor_radius, id, shape.kind, {}};
            return true;
        }
        const SphereInput& input = geometry.spheres[sphere];
        out = {{input.center.x, input.center.y, input.center.z}, input.radius, id, BVH_NONE, {}};
        return false;
    }

    uint32_t primitive(Origin origin) const {
        return geometries_[origin.owner].first_primitive + origin.index;
    }

    const WideTree& wide_;
    const BinaryTree& tree_;
    std::span<const Geometry> geometries_;
    Bvh& out_;
};

uint32_t WideTree::emit(std::span<const Geometry> geometries, const WidePlace& place,
                        Bvh& out) const {
    return Emitter(*this, geometries, out).emit_root(place);
}

} // namespace onde::accel
