// A rectangle of pixels.
#pragma once

#include <cstdint>

namespace onde {

struct Rectangle {
    uint32_t x = 0, y = 0; ///< of the upper left pixel
    uint32_t width = 0, height = 0;

    uint64_t pixels() const { return uint64_t(width) * height; }
    uint32_t end_x() const { return x + width; }
    uint32_t end_y() const { return y + height; }
    bool operator==(const Rectangle&) const = default;
};

} // namespace onde
