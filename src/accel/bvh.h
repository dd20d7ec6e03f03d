// From triangles, spheres and instances to the 16-wide tree that the kernels traverse.
// Values in, values out: no OpenCL, no scene.
#pragma once

#include "core/aligned.h"
#include "core/enum_words.h"
#include "shared/bvh.h"

#include <glm/glm.hpp>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace onde {

struct SphereInput {
    glm::vec3 center{0.0f};
    float radius = 1.0f;
};

/// A canonical shape in object space, of a kind in shared/bvh.h; minor_radius of the torus.
struct ShapeInput {
    uint32_t kind = SHAPE_ELLIPSOID;
    float minor_radius = 0.25f;
};

/// Primitives that share one space. Their global ids are first_primitive + index, triangles first,
/// then spheres, then shapes. Degenerate triangles are allowed; they are never hit. Positions must
/// be finite.
struct Geometry {
    std::span<const glm::vec3> positions;
    std::span<const glm::uvec3> triangles;
    std::span<const SphereInput> spheres;
    uint32_t first_primitive = 0;
    std::span<const ShapeInput> shapes = {}; ///< a geometry with shapes is always an instance

    size_t size() const { return triangles.size() + spheres.size() + shapes.size(); }
};

/// A geometry placed in the world by an affine, invertible transform.
struct Placement {
    uint32_t geometry = 0;
    glm::mat4 object_to_world{1.0f};
    /// Of what moves: where it is at equal steps, between which the matrices are mixed; else none.
    std::span<const glm::mat4> keys = {};
};

/// How a tree is split.
enum class BvhBuilder {
    sah,            ///< by surface-area heuristic, then made 16 wide: built fast
    high,           ///< the same with spatial splits: better to traverse, and longer to build
    median,         ///< in halves by centre, to one primitive a leaf, two children a node (C13)
    median_spatial, ///< the same, but triangles that straddle a cut are cut in two
    none,           ///< not at all: a list of blocks whose boxes exclude nothing
};

constexpr auto enum_words(BvhBuilder) {
    return std::array{EnumWord{BvhBuilder::sah, "sah"}, EnumWord{BvhBuilder::high, "high"},
                      EnumWord{BvhBuilder::median, "median"},
                      EnumWord{BvhBuilder::median_spatial, "median-spatial"},
                      EnumWord{BvhBuilder::none, "none"}};
}

/// How a tree lies in device memory; see shared/bvh.h.
enum class BvhLayout : uint32_t {
    wide = BVH_LAYOUT_WIDE,             ///< 16 children a node, 8 triangles a leaf: for CPUs
    compressed = BVH_LAYOUT_COMPRESSED, ///< 8 children in 80 bytes: for GPUs
    binary = BVH_LAYOUT_BINARY,         ///< 2 children: the plainest for GPUs
};

constexpr auto enum_words(BvhLayout) {
    return std::array{EnumWord{BvhLayout::wide, "wide"},
                      EnumWord{BvhLayout::compressed, "compressed"},
                      EnumWord{BvhLayout::binary, "binary"}};
}

struct BvhOptions {
    BvhBuilder builder = BvhBuilder::sah;
    BvhLayout layout = BvhLayout::wide; ///< that the tree is shaped for; see compact_bvh()
    bool watertight = false;            ///< leaf blocks hold corners, not edges; see TriangleBlock
    uint32_t bins = 32;                 ///< of the surface-area heuristic, per axis
    float traversal_cost = 1.0f;        ///< of entering a wide node
    float leaf_cost = 1.0f;             ///< of testing one leaf block or sphere
    float extra_references = 0.3f;      ///< at most, as part of the primitives, that `high` may add
    bool parallel = true;               ///< the result is the same either way
};

struct BvhStatistics {
    uint32_t triangles = 0, spheres = 0, shapes = 0, instances = 0;
    uint32_t references = 0; ///< to triangles, from leaves: more than those where some are cut
    uint32_t nodes = 0, blocks = 0, depth = 0;
    double children_per_node = 0;
    double triangles_per_block = 0;
    double sah_cost =
        0; ///< expected cost of a random ray that meets the root, in the options' units
    double build_seconds = 0;
};

/// The tree of one world. Placement i becomes instances[i] unless it is attached directly. The keys
/// of those that move follow all instances.
struct Bvh {
    BvhLayout layout = BvhLayout::wide; ///< of the nodes and leaves, some of which are empty
    AlignedVector<BvhNode> nodes;
    AlignedVector<TriangleBlock> blocks;
    AlignedVector<BvhCompressed> compressed;
    AlignedVector<BvhPair> pairs;
    AlignedVector<BvhSlot> slots;
    AlignedVector<BvhSphere> spheres;
    AlignedVector<BvhInstance> instances;
    uint32_t placements = 0;    ///< the first of the instances; behind them lie keys
    uint32_t root = 0;          ///< child word
    uint32_t stack_size = 1;    ///< entries that a traversal may need at once, over both levels
    bool has_instances = false; ///< false when no leaf of the tree is an instance
    bool watertight = false;    ///< as in the options
    bool refitted = false;      ///< leaves of spatial splits hold whole triangles, not parts
    BvhStatistics statistics;
};

/// Builds trees by the binned surface-area heuristic and makes them 16 wide by the SAH-optimal
/// dynamic programme. A geometry that is placed once, by the identity, is attached directly: its
/// hits have no instance. All such geometries share one tree, the world's, in which the instances
/// are leaves; each instanced geometry has a tree of its own. Placed geometries may be empty. The
/// bounds in the nodes have the margin that the kernels' slab test counts on to be conservative.
/// The builders after `high` are laboratory ones. All give the same hits; with spatial splits a
/// triangle may be in several leaves, though once in each. Deterministic, whatever the number of
/// threads. Throws InputError beyond 2^28 blocks, nodes, spheres or placements.
Bvh build_bvh(std::span<const Geometry> geometries, std::span<const Placement> placements,
              const BvhOptions& options = {});

/// Fits a wide tree to primitives that have moved: `geometries` and `placements` are those that it
/// was built over, with new positions, spheres and transforms. Boxes and leaves are written anew,
/// the shape stays: hits are those of a new tree, but the further primitives have moved apart the
/// longer they take, which statistics.sah_cost tells. The triangles of spatial splits get their
/// whole boxes. `options` are those of the build. Throws InputError for other primitives, or a tree
/// in a narrow layout (fit it before compact_bvh).
void refit_bvh(Bvh& bvh, std::span<const Geometry> geometries,
               std::span<const Placement> placements, const BvhOptions& options = {});

/// Adds an instance of nothing, behind all others, for what moves without being met; returns its
/// index. A refit forgets it.
uint32_t add_mover(Bvh& bvh, std::span<const glm::mat4> keys);

/// Moves a wide tree that is shaped for a narrow layout (children of a node, triangles of a leaf, a
/// root that is a node) into that layout; a tree of layout `wide` stays as it is. Boxes only grow,
/// and every traversal finds the same hits. Throws InputError beyond 2^29 primitives.
void compact_bvh(Bvh& bvh, BvhLayout layout);

/// Checks every invariant of the wide layout (bounds contain children, each primitive present, once
/// or in parts that cover it, indices in range, stack_size sufficient, ids ascending in blocks); an
/// empty string, or the first violation.
std::string validate_bvh(const Bvh& bvh, std::span<const Geometry> geometries,
                         std::span<const Placement> placements);

} // namespace onde
