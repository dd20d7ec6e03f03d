// The front door: which geometries hang directly, which are instanced, and how all become one Bvh.
#include "accel/parallel.h"
#include "accel/records.h"
#include "accel/statistics.h"
#include "accel/wide.h"

#include "core/error.h"
#include "core/timer.h"

#include <optional>

namespace onde {

using namespace accel;

namespace {

/// How the placements divide the geometries.
struct Attached {
    std::vector<uint32_t> direct;    ///< geometries whose primitives are the world tree's own
    std::vector<uint32_t> instanced; ///< geometries with a tree of their own
    std::vector<uint32_t> shown;     ///< placements that are instances
};

bool is_empty(const Geometry& geometry) {
    return geometry.size() == 0;
}

Attached divide(std::span<const Geometry> geometries, std::span<const Placement> placements) {
    std::vector<uint32_t> uses(geometries.size(), 0);
    for (const Placement& placement : placements) ++uses[placement.geometry];

    Attached attached;
    std::vector<bool> has_tree(geometries.size(), false);
    for (uint32_t i = 0; i < placements.size(); ++i) {
        const uint32_t geometry = placements[i].geometry;
        if (is_empty(geometries[geometry])) continue;
        if (uses[geometry] == 1 && geometries[geometry].shapes.empty() &&
            placements[i].object_to_world == glm::mat4(1.0f) && placements[i].keys.empty()) {
            attached.direct.push_back(geometry);
            continue;
        }
        attached.shown.push_back(i);
        if (!has_tree[geometry]) attached.instanced.push_back(geometry);
        has_tree[geometry] = true;
    }
    return attached;
}

/// The trees of instanced geometries, by geometry; none where a geometry has no tree.
using Trees = std::vector<std::optional<WideTree>>;

Trees plan_trees(std::span<const Geometry> geometries, const Attached& attached,
                 const BvhOptions& options) {
    Trees trees(geometries.size());
    for_each_child(attached.instanced.size(), options.parallel, [&](size_t i) {
        const uint32_t geometry = attached.instanced[i];
        trees[geometry].emplace(
            make_references(geometries, std::span(&geometry, 1), options.parallel),
            std::span<const WideSize>(), geometries, options);
    });
    return trees;
}

WideTree plan_world(std::span<const Geometry> geometries, std::span<const Placement> placements,
                    const Attached& attached, const Trees& trees, const BvhOptions& options) {
    std::vector<Reference> references =
        make_references(geometries, attached.direct, options.parallel);
    std::vector<WideSize> sizes(placements.size());
    for (uint32_t i : attached.shown) {
        const WideTree& tree = *trees[placements[i].geometry];
        references.emplace_back(placed_box(tree.box(), placements[i]), Reference::INSTANCE, i);
        sizes[i] = tree.size();
    }
    return WideTree(std::move(references), sizes, geometries, options);
}

void check_limits(const WidePlace& total, size_t placements) {
    constexpr uint32_t LIMIT = BVH_INDEX_MASK / 2; // packets number slots in 32 bits
    for (size_t count : {size_t(total.node), size_t(total.block), size_t(total.sphere), placements})
        if (count > LIMIT)
            throw InputError(
                "the scene needs {} nodes, blocks, spheres or instances of one kind in "
                "its tree, more than {}; split it or use fewer triangles",
                count, LIMIT);
}

void check_input(std::span<const Geometry> geometries, std::span<const Placement> placements) {
    size_t primitives = 0;
    for (const Geometry& geometry : geometries) primitives += geometry.size();
    if (primitives + placements.size() >= Reference::SINGLE)
        throw InputError("the scene has {} triangles and spheres, more than a tree can hold; "
                         "split it or use fewer",
                         primitives);
}

} // namespace

Bvh build_bvh(std::span<const Geometry> geometries, std::span<const Placement> placements,
              const BvhOptions& options) {
    const Timer timer;
    check_input(geometries, placements);
    const Attached attached = divide(geometries, placements);
    const Trees trees = plan_trees(geometries, attached, options);
    const WideTree world = plan_world(geometries, placements, attached, trees, options);

    // The world's tree comes first, then the others in the order of their first placement.
    WidePlace total;
    total.advance(world.size());
    std::vector<WidePlace> places(geometries.size());
    for (uint32_t geometry : attached.instanced) {
        places[geometry] = total;
        total.advance(trees[geometry]->size());
    }
    check_limits(total, placements.size());

    Bvh bvh;
    bvh.watertight = options.watertight;
    bvh.nodes.resize(total.node);
    bvh.blocks.resize(total.block);
    bvh.spheres.resize(total.sphere);
    bvh.root = world.emit(geometries, {}, bvh);
    std::vector<uint32_t> roots(geometries.size(), BVH_NONE);
    for_each_child(attached.instanced.size(), options.parallel, [&](size_t i) {
        const uint32_t geometry = attached.instanced[i];
        roots[geometry] = trees[geometry]->emit(geometries, places[geometry], bvh);
    });
    put_instances(placements, roots, bvh.instances);
    bvh.placements = uint32_t(placements.size());

    bvh.has_instances = !attached.shown.empty();
    bvh.stack_size = world.size().stack + 1;
    bvh.statistics = measure_bvh(bvh, options);
    for (const auto& list : {attached.direct, attached.instanced})
        for (uint32_t geometry : list)
            bvh.statistics.triangles += uint32_t(geometries[geometry].triangles.size());
    bvh.statistics.depth = world.size().depth;
    bvh.statistics.instances = uint32_t(attached.shown.size());
    bvh.statistics.build_seconds = timer.seconds();
    return bvh;
}

} // namespace onde
