#include "upload/media.h"

#include "core/error.h"
#include "scene/phong.h"
#include "upload/appearance.h"
#include "upload/words.h"

#include <algorithm>
#include <bit>

namespace onde {

static bool is_something(const Medium& medium) {
    return medium.absorption != glm::vec3(0) || medium.scattering != glm::vec3(0) ||
           medium.emission != glm::vec3(0);
}

/// Whether light gets in.
static bool has_inside(const Material& m) {
    const uint32_t lobes = lobes_of(m);
    return lobes >> LOBE_DIELECTRIC & 1 || (m.medium && lobes >> LOBE_THIN & 1);
}

/// That of coloured glass, and what is stated beside it. A grid says of both how dense they are.
static Medium inside_of(const Material& m) {
    Medium medium = m.medium.value_or(Medium{});
    // Black would be infinite; what is left of it after the distance is nothing to be seen.
    if (!m.thin_walled && m.attenuation_distance)
        medium.absorption -=
            glm::log(glm::max(m.attenuation_color, 1e-6f)) / *m.attenuation_distance;
    return medium;
}

bool has_media(const Scene& scene) {
    const auto scatters = [&](const Material& m) {
        return has_inside(m) && m.medium && is_something(*m.medium);
    };
    return is_something(scene.medium) || std::ranges::any_of(scene.materials, scatters);
}

static uint64_t words_of(const DensityGrid& grid) {
    return grid.bricks.size() * BRICK_WORDS + grid.samples.size();
}

/// The first word of a grid.
static uint64_t first_word(const Scene& scene, uint32_t grid) {
    uint64_t first = 0;
    for (uint32_t i = 0; i < grid; i++) first += words_of(scene.grids[i]);
    return first;
}

static GridRecord grid_record(const Scene& scene, const Medium& medium) {
    const DensityGrid& grid = scene.grids[medium.grid];
    const glm::dmat4 to_world = glm::dmat4(medium.placement) * glm::dmat4(grid.from_samples);
    const glm::mat4 to_samples(glm::inverse(to_world));
    GridRecord record{};
    for (glm::length_t row = 0; row < 3; row++)
        for (glm::length_t column = 0; column < 4; column++)
            record.to_samples[4 * row + column] = to_samples[column][row];
    copy(record.low, grid.low);
    copy(record.high, grid.high);
    record.scale = medium.density_scale;
    record.bricks = uint32_t(first_word(scene, medium.grid));
    for (glm::length_t k = 0; k < 3; k++) record.table[k] = grid.table[k];
    return record;
}

static void add(PackedMedia& packed, const Scene& scene, const Medium& medium) {
    MediumRecord record{};
    copy(record.extinction, medium.absorption + medium.scattering);
    copy(record.scattering, medium.scattering);
    copy(record.emission, medium.emission);
    record.anisotropy = medium.anisotropy;
    record.grid = NO_INDEX;
    if (medium.grid != NO_GRID) {
        record.grid = uint32_t(packed.grids.size());
        packed.grids.push_back(grid_record(scene, medium));
    }
    packed.media.push_back(record);
}

PackedMedia pack_media(const Scene& scene, std::vector<uint32_t>& inside) {
    PackedMedia packed;
    add(packed, scene, scene.medium);
    for (uint32_t i = 0; i < scene.materials.size(); i++) {
        const Material material = path_material(scene, i);
        if (!has_inside(material)) continue;
        inside[i] = uint32_t(packed.media.size());
        add(packed, scene, inside_of(material));
    }
    if (packed.media.size() > MOST_MEDIA)
        throw InputError("the scene has {} clear materials with something inside; at most {} can "
                         "be told apart",
                         packed.media.size() - 1, MOST_MEDIA - 1);
    return packed;
}

std::vector<uint32_t> pack_voxels(const Scene& scene) {
    static_assert(DensityGrid::CELLS == BRICK_CELLS && BRICK_WORDS == 2);
    static_assert(DensityGrid::BRICK_SAMPLES == WORDS_OF_BRICK && DensityGrid::EVEN == NO_INDEX);
    const uint64_t words = first_word(scene, uint32_t(scene.grids.size()));
    if (words >= uint64_t(1) << 31)
        throw InputError("the scene's grids of densities take {} words; at most 2^31 are possible",
                         words);
    std::vector<uint32_t> voxels;
    voxels.reserve(words);
    for (const DensityGrid& grid : scene.grids) {
        const auto samples = uint32_t(voxels.size() + grid.bricks.size() * BRICK_WORDS);
        for (const DensityGrid::Brick& brick : grid.bricks) {
            voxels.push_back(std::bit_cast<uint32_t>(brick.largest));
            voxels.push_back(brick.first == NO_INDEX ? NO_INDEX : samples + brick.first);
        }
        voxels.insert(voxels.end(), grid.samples.begin(), grid.samples.end());
    }
    return voxels;
}

} // namespace onde
