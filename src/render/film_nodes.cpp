#include "render/film_nodes.h"

#include <algorithm>
#include <bit>

namespace onde {

std::vector<FilmNode> cover(uint32_t begin, uint32_t end) {
    std::vector<FilmNode> nodes;
    while (begin < end) {
        const auto fits = uint32_t(std::bit_width(end - begin)) - 1;
        const uint32_t level =
            begin == 0 ? fits : std::min(fits, uint32_t(std::countr_zero(begin)));
        nodes.push_back({level, begin >> level});
        begin += 1u << level;
    }
    return nodes;
}

} // namespace onde
