// Grids of NanoVDB, as NanoVDB.h of OpenVDB 10 lays them out (Museth 2021, NanoVDB: A GPU-Friendly
// and Portable VDB Data Structure): trees of nodes of 32^3, 16^3 and 8^3 children below a root
// table. Nothing in a file is trusted: whatever is read is checked to lie within the grid.
#include "core/shown.h"
#include "scene/grid/bytes.h"
#include "scene/grid/formats.h"
#include "scene/grid/nanovdb_file.h"
#include "scene/load_context.h"

#include <glm/gtc/matrix_transform.hpp>

#include <cmath>
#include <optional>
#include <unordered_map>

namespace onde {
namespace {

constexpr uint64_t GRID = 672, TREE = 64, ROOT = 64, ROOT_TILE = 32; ///< bytes of heads

enum class Type : uint32_t { floats = 1, fp4 = 13, fp8 = 14, fp16 = 15, fpn = 16 };

bool is_known(uint32_t type) {
    return type == uint32_t(Type::floats) ||
           (type >= uint32_t(Type::fp4) && type <= uint32_t(Type::fpn));
}

/// A kind of inner node: 2^log2 children a side, each of 2^below voxels a side.
struct Level {
    uint32_t log2, below;

    uint32_t count() const { return 1u << 3 * log2; }
    uint64_t child_mask() const { return 32 + count() / 8; }
    /// Of the table behind the masks and 16 bytes of statistics, in whole 32 bytes.
    uint64_t table() const { return (32 + count() / 4 + 16 + 31) / 32 * 32; }
    uint64_t size() const { return table() + uint64_t(count()) * 8; }
    uint32_t child(const glm::ivec3& p) const {
        const auto along = [&](int x) { return uint32_t(x) >> below & ((1u << log2) - 1); };
        return (along(p.x) << log2 | along(p.y)) << log2 | along(p.z);
    }
};
constexpr Level UPPER{5, 7}, LOWER{4, 3}, LEAF{3, 0};
constexpr uint64_t LEAF_HEADER = 96;
constexpr uint32_t ROOT_BITS = 12; ///< of coordinates, below the root

uint64_t root_key(const glm::ivec3& p) {
    const auto part = [](int x) { return uint64_t(uint32_t(x) >> ROOT_BITS); };
    return part(p.z) | part(p.y) << 21 | part(p.x) << 42;
}

/// The tree of one grid, whose bytes must outlive it.
class Tree {
  public:
    explicit Tree(const Bytes& grid) : grid_(grid), type_(Type(grid.at<uint32_t>(636))) {
        root_ = GRID + grid.at<uint64_t>(GRID + 24);
        grid_.part(root_, ROOT);
        background_ = grid.at<float>(root_ + 28);
        const uint64_t tiles = grid.at<uint32_t>(root_ + 24);
        grid_.part(root_ + ROOT, tiles * ROOT_TILE);
        for (uint64_t i = 0; i < tiles; ++i) {
            const uint64_t tile = root_ + ROOT + i * ROOT_TILE;
            tiles_.try_emplace(grid.at<uint64_t>(tile), tile);
        }
    }

    /// The box of the voxels that are told, ends included.
    glm::ivec3 low() const { return corner(root_); }
    glm::ivec3 high() const { return corner(root_ + 12); }

    float operator()(const glm::ivec3& p) {
        find_once(p);
        return leaf_ ? value(*leaf_, LEAF.child(p)) : even_;
    }

    /// Of the voxels of a leaf and the next ones, whose first is given.
    std::optional<float> even(const glm::ivec3& first) {
        for (int corner = 0; corner < 8; ++corner) {
            const float before = even_;
            find_once(first + 8 * glm::ivec3(corner & 1, corner >> 1 & 1, corner >> 2));
            if (leaf_ || (corner > 0 && even_ != before)) return std::nullopt;
        }
        return even_;
    }

  private:
    glm::ivec3 corner(uint64_t at) const {
        return {grid_.at<int32_t>(at), grid_.at<int32_t>(at + 4), grid_.at<int32_t>(at + 8)};
    }

    void find_once(const glm::ivec3& p) {
        const glm::ivec3 leaf = p >> 3;
        if (!is_known_ || leaf != known_) find(p);
        known_ = leaf;
        is_known_ = true;
    }

    /// The leaf of a voxel, or the value of all of them where it would be.
    void find(const glm::ivec3& p) {
        leaf_.reset();
        even_ = background_;
        const auto tile = tiles_.find(root_key(p));
        if (tile == tiles_.end()) return;
        const auto child = grid_.at<int64_t>(tile->second + 8);
        even_ = grid_.at<float>(tile->second + 20);
        if (child == 0) return;
        const auto lower = below(root_ + uint64_t(child), UPPER, p);
        const auto leaf = lower ? below(*lower, LOWER, p) : std::nullopt;
        if (!leaf) return;
        grid_.part(*leaf, leaf_size(*leaf));
        leaf_ = leaf;
    }

    /// The child of a node, or nothing where it has a value for all of it.
    std::optional<uint64_t> below(uint64_t node, const Level& level, const glm::ivec3& p) {
        grid_.part(node, level.size());
        const uint32_t child = level.child(p);
        const bool has_child =
            grid_.at<uint8_t>(node + level.child_mask() + child / 8) >> child % 8 & 1;
        const uint64_t entry = node + level.table() + uint64_t(child) * 8;
        if (has_child) return node + uint64_t(grid_.at<int64_t>(entry));
        even_ = grid_.at<float>(entry);
        return std::nullopt;
    }

    uint32_t bits(uint64_t leaf) const {
        if (type_ == Type::fp4) return 4;
        if (type_ == Type::fp8) return 8;
        if (type_ == Type::fp16) return 16;
        return 1u << std::min(grid_.at<uint8_t>(leaf + 15) >> 5, 4);
    }
    uint64_t leaf_size(uint64_t leaf) const {
        grid_.part(leaf, LEAF_HEADER);
        return LEAF_HEADER + (type_ == Type::floats ? 2048 : uint64_t(bits(leaf)) * 64);
    }

    float value(uint64_t leaf, uint32_t voxel) const {
        if (type_ == Type::floats) return grid_.at<float>(leaf + LEAF_HEADER + uint64_t(voxel) * 4);
        const uint32_t width = bits(leaf), bit = voxel * width;
        const uint32_t word = width == 16 ? grid_.at<uint16_t>(leaf + LEAF_HEADER + bit / 8)
                                          : grid_.at<uint8_t>(leaf + LEAF_HEADER + bit / 8);
        const uint32_t code = word >> bit % std::max(width, 8u) & ((1u << width) - 1);
        return float(code) * grid_.at<float>(leaf + 84) + grid_.at<float>(leaf + 80);
    }

    const Bytes& grid_;
    Type type_;
    uint64_t root_ = 0;
    float background_ = 0.0f;
    std::unordered_map<uint64_t, uint64_t> tiles_; ///< by key, where they stand
    bool is_known_ = false;                        ///< what is below: of the last voxel
    glm::ivec3 known_{0};
    std::optional<uint64_t> leaf_;
    float even_ = 0.0f;
};

/// From index coordinates to the grid's own space.
glm::dmat4 index_to_world(const Bytes& grid) {
    glm::dmat4 m(1.0);
    for (glm::length_t row = 0; row < 3; ++row) {
        for (glm::length_t column = 0; column < 3; ++column)
            m[column][row] = grid.at<double>(384 + 8 * uint64_t(3 * row + column));
        m[3][row] = grid.at<double>(528 + 8 * uint64_t(row));
    }
    const double volume = glm::determinant(m);
    if (!std::isfinite(volume) || volume == 0.0) grid.fail("its transform has no inverse");
    return m;
}

} // namespace

DensityGrid read_nanovdb(LoadContext& context, const std::string& name, std::string_view bytes) {
    const Bytes file(bytes, name);
    const StoredGrid stored = choose_grid(file);
    if (!is_known(stored.type))
        throw InputError("{}: the values of its grid '{}' are no floats", name, shown(stored.name));
    std::string room;
    const Bytes grid(unpacked(context, name, file, stored, room), name);
    grid.part(0, GRID + TREE);
    if (grid.at<uint32_t>(636) != stored.type) grid.fail("its types disagree; it is damaged");
    Tree tree(grid);
    const glm::ivec3 low = tree.low(), high = tree.high();
    for (glm::length_t k = 0; k < 3; ++k)
        if (low[k] > high[k] || low[k] < -(1 << 30) || high[k] > 1 << 30 ||
            int64_t(high[k]) - low[k] > int64_t(MOST_SAMPLES) - 16)
            grid.fail("its voxels reach too far, or it has none");
    // Bricks are leaves. A sample more on each side is as dense as it is outside of all voxels.
    const glm::ivec3 first = (low - 1) >> 3 << 3;
    DensityGrid made = make_grid(
        context, name, glm::uvec3(high + 2 - first),
        [&](const glm::uvec3& p) { return tree(first + glm::ivec3(p)); },
        [&](const glm::uvec3& p, const glm::uvec3&) { return tree.even(first + glm::ivec3(p)); });
    made.low = glm::vec3(low - 1 - first);
    made.from_samples = glm::mat4(glm::translate(index_to_world(grid), glm::dvec3(first)));
    return made;
}

} // namespace onde
