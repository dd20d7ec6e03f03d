// Media as device records.
#pragma once

#include "scene/scene.h"
#include "shared/scene.h"

#include <vector>

namespace onde {

/// Whether light meets something between surfaces, other than coloured glass alone.
bool has_media(const Scene& scene);

/// Of scenes that have_media(): what is around, then by material what is inside of it. `inside`
/// becomes each material's index, or NO_INDEX. Throws InputError beyond MOST_MEDIA.
std::vector<MediumRecord> pack_media(const Scene& scene, std::vector<uint32_t>& inside);

} // namespace onde
