#include "scene/fields.h"

#include <fmt/format.h>

#include <cmath>

namespace onde {

std::string why_not_in(const Range& range, double value) {
    if (!std::isfinite(value)) return "must be finite";
    const bool has_end = range.high != ANY_NUMBER.high;
    if (!has_end && std::abs(value) > ANY_NUMBER.high && (value > 0 || range.low < 0))
        return fmt::format("is too large for single precision, which ends at {:.2g}",
                           ANY_NUMBER.high);
    if (range.low == POSITIVE.low && !has_end) return "must be above 0";
    if (!has_end) return "must not be negative";
    return fmt::format("must lie between {} and {}", range.low, range.high);
}

} // namespace onde
