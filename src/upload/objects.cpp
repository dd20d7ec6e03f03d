#include "upload/objects.h"

#include <algorithm>

namespace onde {

uint32_t ObjectMap::operator()(uint32_t primitive, uint32_t instance) const {
    if (instance != NO_INDEX) return of_placement.at(instance);
    const auto behind = std::ranges::upper_bound(runs, primitive, {}, &Run::first_primitive);
    return behind == runs.begin() ? NO_INDEX : std::prev(behind)->object;
}

} // namespace onde
