// Build rates and sizes: a table for people and JSON for machines.
#pragma once

#include "build_contenders.h"
#include "figures.h"

namespace onde::bench {

/// All builds of one builder on one model.
struct BuildResult {
    std::string builder;
    BuiltTree tree;    ///< of the run that measured memory
    Samples seconds{}; ///< of the runs that measured speed
};

struct BuildReport {
    std::string scene;
    uint64_t triangles = 0;
    std::vector<BuildResult> results{};

    double mtriangles(const BuildResult& result) const; ///< per second
    double bytes_per_triangle(const BuildResult& result) const;
};

void print_report(const BuildReport& report);

/// A list of one object per scene and builder; a cost that isn't known is null.
Json json_of(const std::vector<BuildReport>& reports);

} // namespace onde::bench
