// An independent reading of a finished tree: trusts nothing that the builder computed on the way.
#include "accel/reference.h"
#include "accel/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>

namespace onde {

using namespace accel;

namespace {

/// Which primitives a tree must hold, and how often each was seen.
struct Roll {
    std::vector<uint32_t> geometries;
    std::vector<std::vector<uint8_t>> seen; ///< by position in `geometries`, then by index
    /// The leaves of triangles that some leaf's box does not contain, as geometry and index.
    std::map<std::pair<uint32_t, uint32_t>, std::vector<Box>> parts{};
};

/// What is known of a subtree that was traversed.
struct Traversed {
    Box box;            ///< of all its primitives, exact where it has no instances
    uint32_t stack = 0; ///< entries that may wait below it
};

class Validator {
  public:
    Validator(const Bvh& bvh, std::span<const Geometry> geometries,
              std::span<const Placement> placements)
        : bvh_(bvh), geometries_(geometries), placements_(placements),
          visited_(bvh.nodes.size(), false), hung_(placements.size(), false) {}

    std::string run() {
        if (bvh_.instances.size() < placements_.size())
            return fmt::format("{} instances for {} placements", bvh_.instances.size(),
                               placements_.size());
        traverse_instanced_trees();
        const Traversed world = traverse_tree(bvh_.root, world_roll());
        if (problem_.empty()) check_attached();
        if (problem_.empty() && world.stack + 1 > bvh_.stack_size)
            fail("stack_size {} is below {}", bvh_.stack_size, world.stack + 1);
        return problem_;
    }

  private:
    template <class... Args>
    void fail(fmt::format_string<Args...> format, Args&&... args) {
        if (problem_.empty()) problem_ = fmt::format(format, std::forward<Args>(args)...);
    }

    bool is_instanced(uint32_t placement) const {
        return bvh_.instances[placement].root != BVH_NONE;
    }

    Roll make_roll(std::vector<uint32_t> geometries) const {
        Roll roll{std::move(geometries), {}};
        for (uint32_t g : roll.geometries) roll.seen.emplace_back(geometries_[g].size());
        return roll;
    }

    Roll world_roll() const {
        std::vector<uint32_t> direct;
        for (uint32_t i = 0; i < placements_.size(); ++i)
            if (!is_instanced(i)) direct.push_back(placements_[i].geometry);
        return make_roll(std::move(direct));
    }

    void traverse_instanced_trees() {
        for (uint32_t i = 0; i < placements_.size(); ++i) {
            const uint32_t geometry = placements_[i].geometry;
            if (!is_instanced(i) || trees_.contains(geometry)) continue;
            trees_[geometry] = traverse_tree(bvh_.instances[i].root, make_roll({geometry}));
        }
    }

    Traversed traverse_tree(uint32_t root, Roll roll) {
        const Traversed traversed = traverse(root, roll);
        for (size_t g = 0; g < roll.seen.size(); ++g)
            for (size_t i = 0; i < roll.seen[g].size(); ++i) check_seen(roll, g, uint32_t(i));
        return traversed;
    }

    /// Once, but for triangles that lie in parts in several leaves, which must cover them, or whole
    /// after a refit.
    void check_seen(const Roll& roll, size_t g, uint32_t index) {
        const uint32_t owner = roll.geometries[g], seen = roll.seen[g][index];
        const auto parts = roll.parts.find({owner, index});
        if (bvh_.refitted && seen > 1 && parts == roll.parts.end()) return;
        if (seen == 0 || (seen > 1 && parts == roll.parts.end()))
            fail("primitive {} of geometry {} appears {} times", index, owner, seen);
        else if (parts != roll.parts.end() && seen != 1 + parts->second.size() &&
                 seen != parts->second.size())
            fail("triangle {} of geometry {} lies whole in {} leaves", index, owner,
                 seen - parts->second.size());
        else if (parts != roll.parts.end() && seen == parts->second.size())
            check_cover(owner, index, parts->second);
    }

    void check_cover(uint32_t owner, uint32_t index, std::span<const Box> parts) {
        constexpr int STEPS = 12;
        const Geometry& geometry = geometries_[owner];
        const glm::uvec3 corners = geometry.triangles[index];
        const glm::dvec3 a(geometry.positions[corners.x]);
        const glm::dvec3 e1 = glm::dvec3(geometry.positions[corners.y]) - a;
        const glm::dvec3 e2 = glm::dvec3(geometry.positions[corners.z]) - a;
        for (int u = 0; u <= STEPS; ++u)
            for (int v = 0; u + v <= STEPS; ++v) {
                const glm::vec3 point(a + (double(u) * e1 + double(v) * e2) / double(STEPS));
                const Box at = {lanes(point), lanes(point)};
                if (std::ranges::none_of(parts, [&](const Box& box) { return box.contains(at); }))
                    fail("the leaves of triangle {} of geometry {} do not contain all of it", index,
                         owner);
            }
    }

    Traversed traverse(uint32_t word, Roll& roll, const Box& bounds = everywhere()) {
        if (!problem_.empty()) return {};
        const uint32_t index = word & BVH_INDEX_MASK;
        if (!(word & BVH_LEAF)) return traverse_node(word, roll);
        switch (word & BVH_KIND_MASK) {
        case BVH_LEAF_TRIANGLES:
            return traverse_block(index, roll, bounds);
        case BVH_LEAF_SPHERE:
            return traverse_sphere(index, roll);
        case BVH_LEAF_SHAPE:
            return traverse_shape(index, roll);
        case BVH_LEAF_INSTANCE:
            return traverse_instance(index);
        }
        fail("child word {:#x} has no kind", word);
        return {};
    }

    Traversed traverse_node(uint32_t index, Roll& roll) {
        if (index >= bvh_.nodes.size() || visited_[index]) {
            fail("node {} is out of range or has two parents", index);
            return {};
        }
        visited_[index] = true;
        const BvhNode& node = bvh_.nodes[index];
        Traversed result;
        uint32_t children = 0;
        for (uint32_t slot = 0; slot < BVH_WIDTH; ++slot) {
            const Box bounds = slot_box(node, slot);
            if (bounds.is_empty()) continue;
            const Traversed child = traverse(node.child[slot], roll, bounds);
            if (!child.box.is_empty() && !bounds.contains(child.box))
                fail("slot {} of node {} does not contain its child", slot, index);
            result.box.extend(bounds);
            result.stack = std::max(result.stack, child.stack);
            ++children;
        }
        if (children > 1) result.stack += children - 1;
        return result;
    }

    /// Marks the primitive with that global id in the roll; none where the tree must not hold it.
    std::optional<std::pair<uint32_t, uint32_t>> mark(uint32_t id, Roll& roll) {
        for (size_t g = 0; g < roll.geometries.size(); ++g) {
            const uint32_t index = id - geometries_[roll.geometries[g]].first_primitive;
            if (index >= roll.seen[g].size()) continue; // also where the difference wrapped
            roll.seen[g][index] += roll.seen[g][index] < 255;
            return std::pair(roll.geometries[g], index);
        }
        fail("primitive {} does not belong to this tree", id);
        return std::nullopt;
    }

    static Box everywhere() {
        constexpr float INFINITE = std::numeric_limits<float>::infinity();
        return {splat(-INFINITE), splat(INFINITE)};
    }

    Traversed traverse_block(uint32_t index, Roll& roll, const Box& bounds) {
        if (index >= bvh_.blocks.size()) {
            fail("block {} is out of range", index);
            return {};
        }
        const TriangleBlock& block = bvh_.blocks[index];
        Traversed result;
        for (uint32_t lane = 0; lane < BVH_LEAF_WIDTH; ++lane) {
            const uint32_t id = block.primitive[lane];
            if (lane > 0 && id <= block.primitive[lane - 1] && id != BVH_NONE)
                fail("ids of block {} do not ascend", index);
            if (id == BVH_NONE)
                check_empty_lane(block, lane, index);
            else if (const auto found = mark(id, roll)) {
                const Box box = check_triangle(block, lane, *found);
                if (!bounds.contains(box)) roll.parts[*found].push_back(bounds);
                result.box.extend(box.common(bounds));
            }
        }
        return result;
    }

    void check_empty_lane(const TriangleBlock& block, uint32_t lane, uint32_t index) {
        const float edges[] = {block.e1_x[lane], block.e1_y[lane], block.e1_z[lane],
                               block.e2_x[lane], block.e2_y[lane], block.e2_z[lane]};
        for (float edge : edges)
            if (edge != 0.0f) fail("empty lane {} of block {} has a triangle", lane, index);
    }

    Box check_triangle(const TriangleBlock& block, uint32_t lane,
                       std::pair<uint32_t, uint32_t> found) {
        const auto [owner, index] = found;
        const Geometry& geometry = geometries_[owner];
        if (index >= geometry.triangles.size()) {
            fail("sphere {} of geometry {} lies in a triangle block", index, owner);
            return {};
        }
        const glm::uvec3 corners = geometry.triangles[index];
        const glm::vec3 v0 = geometry.positions[corners.x];
        const glm::vec3 stored[] = {{block.v0_x[lane], block.v0_y[lane], block.v0_z[lane]},
                                    {block.e1_x[lane], block.e1_y[lane], block.e1_z[lane]},
                                    {block.e2_x[lane], block.e2_y[lane], block.e2_z[lane]}};
        const glm::vec3 from = bvh_.watertight ? glm::vec3(0.0f) : v0;
        if (stored[0] != v0 || stored[1] != geometry.positions[corners.y] - from ||
            stored[2] != geometry.positions[corners.z] - from)
            fail("triangle {} of geometry {} is stored with other corners", index, owner);
        return triangle_box(geometry, index);
    }

    Traversed traverse_sphere(uint32_t index, Roll& roll) {
        if (index >= bvh_.spheres.size()) {
            fail("sphere {} is out of range", index);
            return {};
        }
        const BvhSphere& sphere = bvh_.spheres[index];
        const auto found = mark(sphere.primitive, roll);
        if (!found) return {};
        const Geometry& geometry = geometries_[found->first];
        if (found->second < geometry.triangles.size()) {
            fail("triangle {} is stored as a sphere", sphere.primitive);
            return {};
        }
        const size_t sphere_index = found->second - geometry.triangles.size();
        if (sphere_index >= geometry.spheres.size()) {
            fail("shape {} is stored as a sphere", sphere.primitive);
            return {};
        }
        const SphereInput& input = geometry.spheres[sphere_index];
        const glm::vec3 center(sphere.center[0], sphere.center[1], sphere.center[2]);
        if (center != input.center || sphere.radius != input.radius)
            fail("sphere {} is stored with another centre or radius", sphere.primitive);
        return {sphere_box(input), 0};
    }

    Traversed traverse_shape(uint32_t index, Roll& roll) {
        if (index >= bvh_.spheres.size()) {
            fail("shape {} is out of range", index);
            return {};
        }
        const BvhSphere& shape = bvh_.spheres[index];
        const auto found = mark(shape.primitive, roll);
        if (!found) return {};
        const Geometry& geometry = geometries_[found->first];
        const size_t others = geometry.triangles.size() + geometry.spheres.size();
        if (found->second < others) {
            fail("triangle or sphere {} is stored as a shape", shape.primitive);
            return {};
        }
        const ShapeInput& input = geometry.shapes[found->second - others];
        if (shape.kind != input.kind || shape.radius != input.minor_radius)
            fail("shape {} is stored with another kind or radius", shape.primitive);
        return {shape_box(input), 0};
    }

    Traversed traverse_instance(uint32_t index) {
        if (index >= placements_.size() || !is_instanced(index) || hung_[index]) {
            fail("instance {} is out of range, has no tree, or is referenced twice", index);
            return {};
        }
        hung_[index] = true;
        const Traversed& tree = trees_.at(placements_[index].geometry);
        check_inverse(index);
        return {world_box(tree.box, placements_[index].object_to_world), tree.stack + 1};
    }

    /// The box of the transformed corners, in double precision.
    static Box world_box(const Box& box, const glm::mat4& transform) {
        Box result;
        for (int corner = 0; corner < 8; ++corner) {
            const glm::dvec4 point(
                box.low[0] + (corner & 1) * (double(box.high[0]) - box.low[0]),
                box.low[1] + (corner >> 1 & 1) * (double(box.high[1]) - box.low[1]),
                box.low[2] + (corner >> 2) * (double(box.high[2]) - box.low[2]), 1.0);
            result.extend(lanes(glm::vec3(glm::dmat4(transform) * point)));
        }
        return result;
    }

    void check_inverse(uint32_t index) {
        const BvhInstance& instance = bvh_.instances[index];
        for (int row = 0; row < 3; ++row)
            for (int column = 0; column < 3; ++column) {
                double product = 0, magnitude = 1;
                for (int k = 0; k < 3; ++k) {
                    const double term = double(instance.world_to_object[4 * row + k]) *
                                        instance.object_to_world[4 * k + column];
                    product += term;
                    magnitude += std::abs(term);
                }
                if (!(std::abs(product - (row == column)) < 1e-5 * magnitude))
                    fail("the matrices of instance {} are not inverse to each other", index);
            }
    }

    void check_attached() {
        bool any = false;
        for (uint32_t i = 0; i < placements_.size(); ++i) {
            if (is_instanced(i) && !hung_[i]) fail("instance {} does not hang in the tree", i);
            any = any || hung_[i];
        }
        if (any != bvh_.has_instances) fail("has_instances is {}", bvh_.has_instances);
        for (size_t i = 0; i < visited_.size(); ++i)
            if (!visited_[i]) fail("node {} can't be reached", i);
    }

    const Bvh& bvh_;
    std::span<const Geometry> geometries_;
    std::span<const Placement> placements_;
    std::vector<bool> visited_, hung_;
    std::map<uint32_t, Traversed> trees_; ///< of instanced geometries
    std::string problem_;
};

} // namespace

std::string validate_bvh(const Bvh& bvh, std::span<const Geometry> geometries,
                         std::span<const Placement> placements) {
    return Validator(bvh, geometries, placements).run();
}

} // namespace onde
