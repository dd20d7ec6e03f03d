// Rates, spreads, ratios: tables for people and JSON for machines.
#pragma once

#include "traversal_race.h"

namespace onde::bench {

/// All contenders on one ray set of one scene.
struct SetReport {
    std::string scene, set;
    size_t triangles = 0, rays = 0;
    std::vector<Timing> timings{};

    double mrays(const Timing& timing) const; ///< per second
    const Timing& best(Side side) const;      ///< the fastest by median
    double ratio() const;                     ///< best of Onde, not watertight, over best of Embree
};

/// One set: rates in Mrays/s, and their ratio to Embree's best.
void print_report(const SetReport& report);

/// One line a scene and set: the best of Onde beside the best of Embree.
void print_summary(const std::vector<SetReport>& reports);

/// A list of one object per scene and set.
Json json_of(const std::vector<SetReport>& reports, const std::string& device);

} // namespace onde::bench
