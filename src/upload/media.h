// Media as device records.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <vector>

namespace onde {

/// Whether light meets something between surfaces, other than coloured glass alone.
bool has_media(const Scene& scene);

struct PackedMedia {
    std::vector<MediumRecord> media;
    std::vector<GridRecord> grids; ///< one for each medium that has one
};

/// Of scenes that have_media(): what is around, then by material what is inside of it. `inside`
/// becomes each material's index, or NO_INDEX. Throws InputError beyond MOST_MEDIA.
PackedMedia pack_media(const Scene& scene, std::vector<uint32_t>& inside);

/// The tables of the scene's grids and their samples; see GridRecord. Throws InputError beyond 2^31
/// words.
std::vector<uint32_t> pack_voxels(const Scene& scene);

} // namespace onde
