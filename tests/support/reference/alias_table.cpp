#include "support/reference/alias_table.h"

#include <numeric>

namespace onde::reference {

AliasTable::AliasTable(std::span<const float> weights) {
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    if (!(total > 0.0)) return;
    const auto count = uint32_t(weights.size());
    bins_.resize(count);
    std::vector<double> scaled(count);
    std::vector<uint32_t> small, large;
    for (uint32_t i = 0; i < count; ++i) {
        scaled[i] = double(weights[i]) / total * count;
        bins_[i] = {1.0f, i, float(double(weights[i]) / total)};
        (scaled[i] < 1.0 ? small : large).push_back(i);
    }
    while (!small.empty() && !large.empty()) {
        const uint32_t poor = small.back(), rich = large.back();
        small.pop_back();
        bins_[poor].below = float(scaled[poor]);
        bins_[poor].alias = rich;
        scaled[rich] -= 1.0 - scaled[poor];
        if (scaled[rich] < 1.0) {
            large.pop_back();
            small.push_back(rich);
        }
    }
}

} // namespace onde::reference
