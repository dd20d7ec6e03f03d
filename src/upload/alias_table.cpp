#include "upload/alias_table.h"

#include <numeric>

namespace onde {

std::vector<AliasEntry> build_alias_table(std::span<const double> weights) {
    const size_t count = weights.size();
    std::vector<AliasEntry> table(count);
    if (count == 0) return table;
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> scaled(count); // mean 1
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < count; i++) {
        const double share = total > 0 ? weights[i] / total : 1.0 / double(count);
        table[i] = {1.0f, i, float(share)};
        scaled[i] = share * double(count);
        (scaled[i] < 1 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const uint32_t below = small.back(), above = large.back();
        small.pop_back();
        table[below].below = float(scaled[below]);
        table[below].alias = above;
        scaled[above] -= 1 - scaled[below];
        if (scaled[above] < 1) {
            large.pop_back();
            small.push_back(above);
        }
    }
    return table; // what is left over stays with itself: its weight is 1 but for rounding
}

} // namespace onde
