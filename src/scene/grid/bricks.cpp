// Samples into bricks.
#include "core/error.h"
#include "scene/grid.h"
#include "scene/load_context.h"

#include <glm/gtc/matrix_transform.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace onde {
namespace {

constexpr uint32_t CELLS = DensityGrid::CELLS, CORNERS = CELLS + 1;
constexpr uint32_t MOST = 65535; ///< the share of a brick's largest density that is all of it

/// The samples at the corners of a brick's cells, x fastest.
using Corners = std::array<float, size_t(CORNERS) * CORNERS * CORNERS>;

/// What counts of a density.
float usable(float density) {
    return density > 0.0f ? std::min(density, LARGEST_DENSITY) : 0.0f;
}

Corners corners_of(const glm::uvec3& brick, const glm::uvec3& count, const DensityAt& density) {
    Corners corners;
    size_t i = 0;
    for (uint32_t z = 0; z < CORNERS; ++z)
        for (uint32_t y = 0; y < CORNERS; ++y)
            for (uint32_t x = 0; x < CORNERS; ++x)
                corners[i++] =
                    usable(density(glm::min(brick * CELLS + glm::uvec3(x, y, z), count - 1u)));
    return corners;
}

void add_samples(DensityGrid& grid, const Corners& corners, float largest) {
    const auto share = [&](size_t i) {
        return uint32_t(std::lround(double(corners[i]) / double(largest) * MOST));
    };
    for (size_t row = 0; row < size_t(CORNERS) * CORNERS; ++row)
        for (size_t x = 0; x < CELLS; ++x) {
            const size_t i = row * CORNERS + x;
            grid.samples.push_back(share(i) | share(i + 1) << 16);
        }
}

} // namespace

DensityGrid make_grid(LoadContext& context, const std::string& where, const glm::uvec3& count,
                      const DensityAt& density, const EvenDensity& even) {
    DensityGrid grid;
    grid.high = glm::vec3(count - 1u);
    grid.table = (count - 1u + CELLS - 1u) / CELLS;
    const uint64_t bricks = uint64_t(grid.table.x) * grid.table.y * grid.table.z;
    if (std::max({count.x, count.y, count.z}) > MOST_SAMPLES || bricks > MOST_BRICKS)
        throw InputError(
            "{}: a grid of {} x {} x {} samples is too large; at most {} a side, {} in "
            "all, are possible",
            where, count.x, count.y, count.z, MOST_SAMPLES, MOST_BRICKS * 512);
    context.spend(bricks, 3 * sizeof(DensityGrid::Brick), where);
    grid.bricks.reserve(bricks);
    GradualSpending cost(context, where);
    glm::uvec3 b;
    for (b.z = 0; b.z < grid.table.z; ++b.z)
        for (b.y = 0; b.y < grid.table.y; ++b.y)
            for (b.x = 0; b.x < grid.table.x; ++b.x) {
                if (const auto d = even ? even(b * CELLS, (b + 1u) * CELLS) : std::nullopt) {
                    grid.bricks.push_back({usable(*d), DensityGrid::EVEN});
                    continue;
                }
                const Corners corners = corners_of(b, count, density);
                const auto [least, largest] = std::ranges::minmax(corners);
                const bool is_even = least == largest;
                const auto first = uint32_t(grid.samples.size());
                grid.bricks.push_back({largest, is_even ? DensityGrid::EVEN : first});
                if (is_even) continue;
                cost.add(3 * DensityGrid::BRICK_SAMPLES * sizeof(uint32_t));
                add_samples(grid, corners, largest);
            }
    return grid;
}

DensityGrid make_cell_grid(LoadContext& context, const std::string& where, const glm::uvec3& count,
                           std::span<const float> densities, const glm::dvec3& low,
                           const glm::dvec3& high) {
    const auto nearest = [&](const glm::uvec3& padded) {
        const glm::uvec3 cell = glm::clamp(padded, glm::uvec3(1), count) - 1u;
        return densities[cell.x + size_t(count.x) * (cell.y + size_t(count.y) * cell.z)];
    };
    DensityGrid grid = make_grid(context, where, count + 2u, nearest);
    grid.low = glm::vec3(0.5f);
    grid.high = glm::vec3(count) + 0.5f;
    const glm::dvec3 cell = (high - low) / glm::dvec3(count);
    const glm::dmat4 to_corner = glm::translate(glm::dmat4(1.0), low - 0.5 * cell);
    grid.from_samples = glm::mat4(glm::scale(to_corner, cell));
    return grid;
}

float density_at(const DensityGrid& grid, const glm::vec3& p) {
    if (glm::any(glm::lessThan(p, grid.low)) || glm::any(glm::greaterThan(p, grid.high))) return 0;
    const glm::uvec3 brick = glm::min(glm::uvec3(p) / CELLS, grid.table - 1u);
    const size_t index =
        brick.x + size_t(grid.table.x) * (brick.y + size_t(grid.table.y) * brick.z);
    const DensityGrid::Brick& found = grid.bricks[index];
    if (found.first == DensityGrid::EVEN) return found.largest;
    const glm::vec3 local = p - glm::vec3(brick * CELLS);
    const glm::uvec3 cell = glm::min(glm::uvec3(local), glm::uvec3(CELLS - 1));
    const glm::vec3 f = local - glm::vec3(cell);
    const auto along_x = [&](uint32_t y, uint32_t z) {
        const uint32_t word = grid.samples[found.first + cell.x + CELLS * (cell.y + y) +
                                           CELLS * CORNERS * (cell.z + z)];
        return glm::mix(float(word & 0xffff), float(word >> 16), f.x);
    };
    const float front = glm::mix(along_x(0, 0), along_x(1, 0), f.y);
    const float behind = glm::mix(along_x(0, 1), along_x(1, 1), f.y);
    return glm::mix(front, behind, f.z) / float(MOST) * found.largest;
}

} // namespace onde
