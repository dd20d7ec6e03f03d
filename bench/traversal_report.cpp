#include "traversal_report.h"

#include "core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

namespace onde::bench {

namespace {

double median_of(const Report& report, const std::string& set, const std::string& contender) {
    for (const Timing& timing : report.timings)
        if (timing.set == set && timing.contender == contender) return timing.median();
    return 0;
}

std::string json_of(const Build& build) {
    return fmt::format(R"({{"builder": "{}", "seconds": {:.4f}, "mtriangles_per_second": {:.3f}, )"
                       R"("bytes_per_triangle": {:.1f}, "sah_cost": {:.3f}}})",
                       build.builder, build.seconds, build.mtriangles, build.bytes_per_triangle,
                       build.sah_cost);
}

std::string json_of(const Timing& timing) {
    return fmt::format(
        R"({{"set": "{}", "contender": "{}", "rays": {}, "mrays_per_second": {:.3f}, )"
        R"("spread": {:.3f}, "differences": {}, "seconds": [{:.5f}]}})",
        timing.set, timing.contender, timing.rays, timing.mrays(), timing.spread(),
        timing.differences, fmt::join(timing.seconds, ", "));
}

template <class T>
std::string json_list(const std::vector<T>& values) {
    std::vector<std::string> parts;
    for (const T& value : values) parts.push_back("      " + json_of(value));
    return fmt::format("[\n{}\n    ]", fmt::join(parts, ",\n"));
}

std::string json_of(const Report& report) {
    return fmt::format("  {{\n    \"scene\": \"{}\", \"triangles\": {}, \"device\": \"{}\",\n"
                       "    \"version\": \"{}\",\n    \"builds\": {},\n    \"timings\": {}\n  }}",
                       report.scene, report.triangles, report.device, ONDE_VERSION,
                       json_list(report.builds), json_list(report.timings));
}

} // namespace

double Timing::median() const {
    std::vector<double> sorted = seconds;
    std::ranges::sort(sorted);
    return sorted[sorted.size() / 2];
}

double Timing::spread() const {
    const auto [fastest, slowest] = std::ranges::minmax(seconds);
    return (slowest - fastest) / median();
}

void print_report(const Report& report, const std::string& reference) {
    fmt::print("\n{}: {} triangles, {}\n", report.scene, report.triangles, report.device);
    for (const Build& build : report.builds)
        fmt::print("  build {:<14} {:7.3f} s {:7.2f} Mtriangles/s {:7.1f} bytes/triangle{}\n",
                   build.builder, build.seconds, build.mtriangles, build.bytes_per_triangle,
                   build.sah_cost > 0 ? fmt::format("  SAH cost {:.2f}", build.sah_cost) : "");
    fmt::print("  {:<9} {:<15} {:>9} {:>8} {:>7} {:>8} {:>10}\n", "rays", "contender", "Mrays/s",
               "ratio", "spread", "count", "different");
    for (const Timing& timing : report.timings)
        fmt::print("  {:<9} {:<15} {:9.2f} {:8.2f} {:6.0f}% {:8} {:10}\n", timing.set,
                   timing.contender, timing.mrays(),
                   median_of(report, timing.set, reference) / timing.median(),
                   100 * timing.spread(), timing.rays, timing.differences);
}

void write_json(const std::vector<Report>& reports, const std::string& path) {
    std::vector<std::string> parts;
    for (const Report& report : reports) parts.push_back(json_of(report));
    std::ofstream file(path);
    file << fmt::format("[\n{}\n]\n", fmt::join(parts, ",\n"));
    if (!file.flush())
        throw InputError("{} can't be written; choose a folder that exists and is writable", path);
}

} // namespace onde::bench
