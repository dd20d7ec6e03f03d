// Densities of media on a regular grid, and the readers of its files. Samples lie at whole
// coordinates; between them the density is linear, as kernels/shared/scene.h has it in bricks.
#pragma once

#include <glm/glm.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace onde {

class LoadContext;

/// Of a medium without a grid.
inline constexpr uint32_t NO_GRID = 0xffffffff;

/// Of a grid: samples a side, bricks in all; larger densities than that are taken for it.
inline constexpr uint32_t MOST_SAMPLES = 1u << 20, MOST_BRICKS = 1u << 24;
inline constexpr float LARGEST_DENSITY = 1e15f;

struct DensityGrid {
    /// Along an edge of a brick; and the words of its samples.
    static constexpr uint32_t CELLS = 8, BRICK_SAMPLES = CELLS * (CELLS + 1) * (CELLS + 1);
    /// Where `first` of a brick is none: all of it has the density `largest`.
    static constexpr uint32_t EVEN = 0xffffffff;

    struct Brick {
        float largest = 0.0f;
        uint32_t first = EVEN; ///< of its words

        bool operator==(const Brick&) const = default;
    };

    std::string name;
    glm::uvec3 table{0};           ///< bricks along each axis
    glm::vec3 low{0}, high{0};     ///< in samples: the density is 0 outside
    glm::mat4 from_samples{1.0f};  ///< to the grid's own space
    std::vector<Brick> bricks;     ///< x fastest
    std::vector<uint32_t> samples; ///< BRICK_SAMPLES words for each brick that has some

    uint64_t bytes() const { return bricks.size() * sizeof(Brick) + samples.size() * 4; }
};

/// A sample by its coordinates; those that are negative or no numbers count as 0.
using DensityAt = std::function<float(const glm::uvec3&)>;

/// The density of all samples from one to another, where it is known to be the same.
using EvenDensity =
    std::function<std::optional<float>(const glm::uvec3& first, const glm::uvec3& last)>;

/// The bricks of `count` samples along each axis, at least 2; the box is that of all samples. What
/// they take is spent first. Throws OverBudget, and InputError for more than a grid may have.
DensityGrid make_grid(LoadContext& context, const std::string& where, const glm::uvec3& count,
                      const DensityAt& density, const EvenDensity& even = {});

/// Of samples that stand for the cells of a box of the grid's own space, x fastest, each the
/// density in the middle of its cell: up to the faces of the box it is that of the outermost.
DensityGrid make_cell_grid(LoadContext& context, const std::string& where, const glm::uvec3& count,
                           std::span<const float> densities, const glm::dvec3& low,
                           const glm::dvec3& high);

/// The grid of a `.nvdb` or `.vol` file. Throws InputError with the file's name for what is not one
/// or is damaged.
DensityGrid load_grid(LoadContext& context, const std::filesystem::path& path);

/// Of a density at a place in samples, as kernels have it: for tests and reports.
float density_at(const DensityGrid& grid, const glm::vec3& samples);

} // namespace onde
