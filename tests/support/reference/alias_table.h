// Choosing an index with probability proportional to its weight, in constant time.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace onde::reference {

/// Vose's alias method (Vose 1991).
class AliasTable {
  public:
    AliasTable() = default;
    /// Weights are >= 0; if all are zero the table is empty.
    explicit AliasTable(std::span<const float> weights);

    struct Choice {
        uint32_t index;
        float pmf;
    };
    /// u in [0, 1). The table is not empty.
    Choice sample(float u) const {
        const float scaled = u * float(bins_.size());
        const uint32_t i = std::min(uint32_t(scaled), uint32_t(bins_.size() - 1));
        const uint32_t index = scaled - float(i) < bins_[i].below ? i : bins_[i].alias;
        return {index, bins_[index].pmf};
    }
    float pmf(uint32_t index) const { return bins_[index].pmf; }
    bool empty() const { return bins_.empty(); }

  private:
    struct Bin {
        float below;
        uint32_t alias;
        float pmf;
    };
    std::vector<Bin> bins_;
};

} // namespace onde::reference
