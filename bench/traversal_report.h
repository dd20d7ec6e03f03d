// Medians, spreads, a table for people and a JSON file for machines.
#pragma once

#include <string>
#include <vector>

namespace onde::bench {

/// Repetitions of one contender on one ray set.
struct Timing {
    std::string set, contender;
    size_t rays = 0;
    std::vector<double> seconds{};
    size_t differences = 0; ///< answers unlike the reference's

    double median() const;
    double mrays() const { return double(rays) / median() * 1e-6; }
    double spread() const; ///< (slowest - fastest) / median
};

struct Build {
    std::string builder;
    double seconds = 0, mtriangles = 0, bytes_per_triangle = 0;
    double sah_cost = 0; ///< 0 where unknown
};

struct Report {
    std::string scene, device;
    size_t triangles = 0;
    std::vector<Build> builds{};
    std::vector<Timing> timings{};
};

/// Rates in Mrays/s, ratios to `reference` on the same set, spreads in percent.
void print_report(const Report& report, const std::string& reference);

/// Throws InputError when the file can't be written.
void write_json(const std::vector<Report>& reports, const std::string& path);

} // namespace onde::bench
