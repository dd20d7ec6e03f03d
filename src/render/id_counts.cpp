#include "render/id_counts.h"

#include <algorithm>

namespace onde {

void add_id(PixelIds& ids, SeenId id, uint32_t count) {
    const auto place = std::ranges::lower_bound(ids, id, {}, &IdCount::id);
    if (place != ids.end() && place->id == id)
        place->count += count;
    else
        ids.insert(place, {id, count});
}

size_t most_ids(const IdCounts& counts) {
    size_t most = 0;
    for (const PixelIds& ids : counts) most = std::max(most, ids.size());
    return most;
}

} // namespace onde
