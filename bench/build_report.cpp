#include "build_report.h"

#include <fmt/format.h>

#include <cstdio>
#include <thread>

namespace onde::bench {

double BuildReport::mtriangles(const BuildResult& result) const {
    return double(triangles) / median(result.seconds) * 1e-6;
}
double BuildReport::bytes_per_triangle(const BuildResult& result) const {
    return double(result.tree.bytes) / double(triangles);
}

void print_report(const BuildReport& report) {
    fmt::print("\n{}: {} triangles, {} threads\n", report.scene, report.triangles,
               std::thread::hardware_concurrency());
    fmt::print("  {:<20} {:>12} {:>7} {:>9} {:>15} {:>10}\n", "builder", "Mtriangles/s", "spread",
               "SAH cost", "bytes/triangle", "peak MiB");
    for (const BuildResult& result : report.results) {
        const auto cost = result.tree.sah_cost;
        fmt::print("  {:<20} {:12.2f} {:6.0f}% {:>9} {:15.1f} {:10.1f}\n", result.builder,
                   report.mtriangles(result), 100 * spread(result.seconds),
                   cost ? fmt::format("{:.2f}", *cost) : "-", report.bytes_per_triangle(result),
                   double(result.tree.peak_bytes) / 1048576);
    }
    std::fflush(stdout);
}

Json json_of(const std::vector<BuildReport>& reports) {
    const std::string commit = source_commit();
    Json list = Json::array();
    for (const BuildReport& report : reports)
        for (const BuildResult& result : report.results) {
            const auto cost = result.tree.sah_cost;
            list.push_back({{"scene", report.scene},
                            {"builder", result.builder},
                            {"mtriangles_per_second", report.mtriangles(result)},
                            {"sah_cost", cost ? Json(*cost) : Json(nullptr)},
                            {"bytes_per_triangle", report.bytes_per_triangle(result)},
                            {"peak_bytes", result.tree.peak_bytes},
                            {"triangles", report.triangles},
                            {"seconds", result.seconds},
                            {"threads", std::thread::hardware_concurrency()},
                            {"commit", commit}});
        }
    return list;
}

} // namespace onde::bench
