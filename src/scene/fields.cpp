#include "scene/fields.h"

#include <fmt/format.h>

namespace onde {

std::string must_lie_in(const Range& range) {
    if (range.low == POSITIVE.low && range.high == POSITIVE.high) return "must be above 0";
    if (range.high == ANY_NUMBER.high)
        return range.low == 0.0 ? "must be finite and not negative" : "must be finite";
    return fmt::format("must lie between {} and {}", range.low, range.high);
}

} // namespace onde
