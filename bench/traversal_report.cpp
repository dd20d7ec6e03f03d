#include "traversal_report.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <thread>

namespace onde::bench {

double SetReport::mrays(const Timing& timing) const {
    return double(rays) / median(timing.seconds) * 1e-6;
}

const Timing& SetReport::best(Side side) const {
    const auto rate = [&](const Timing& timing) {
        return timing.side == side ? mrays(timing) : 0.0;
    };
    return *std::ranges::max_element(timings, {}, rate);
}

double SetReport::ratio() const {
    return mrays(best(Side::onde)) / mrays(best(Side::embree));
}

void print_report(const SetReport& report) {
    fmt::print("\n{}, {}: {} rays, {} triangles\n", report.scene, report.set, report.rays,
               report.triangles);
    fmt::print("  {:<26} {:>9} {:>7} {:>7} {:>10}\n", "contender", "Mrays/s", "spread", "ratio",
               "different");
    const double best = report.mrays(report.best(Side::embree));
    for (const Timing& timing : report.timings)
        fmt::print("  {:<26} {:9.2f} {:6.0f}% {:7.2f} {:10}\n", timing.contender,
                   report.mrays(timing), 100 * spread(timing.seconds), report.mrays(timing) / best,
                   timing.mismatches);
    std::fflush(stdout);
}

void print_summary(const std::vector<SetReport>& reports) {
    size_t width = 5;
    for (const SetReport& report : reports) width = std::max(width, report.scene.size());
    fmt::print("\nbest of Onde over best of Embree, Mrays/s\n");
    fmt::print("  {:<{}} {:<8} {:>6} {:>9}  {:<12} {:>9}  {:<26} {:>9}\n", "scene", width, "set",
               "ratio", "Onde", "", "Embree", "", "different");
    for (const SetReport& report : reports) {
        const Timing &onde = report.best(Side::onde), &embree = report.best(Side::embree);
        fmt::print("  {:<{}} {:<8} {:6.2f} {:9.2f}  {:<12} {:9.2f}  {:<26} {:9}\n", report.scene,
                   width, report.set, report.ratio(), report.mrays(onde), onde.contender,
                   report.mrays(embree), embree.contender, onde.mismatches);
    }
}

static Json json_of(const SetReport& report) {
    const Timing &onde = report.best(Side::onde), &embree = report.best(Side::embree);
    Json modes = Json::object();
    for (const Timing& timing : report.timings) modes[timing.contender] = report.mrays(timing);
    return {{"scene", report.scene},
            {"set", report.set},
            {"onde_mrays", report.mrays(onde)},
            {"embree_best_mrays", report.mrays(embree)},
            {"embree_best_mode", embree.contender},
            {"ratio", report.ratio()},
            {"mismatches", onde.mismatches},
            {"onde_best_variant", onde.contender},
            {"modes", modes},
            {"rays", report.rays},
            {"triangles", report.triangles},
            {"repetitions", onde.seconds.size()}};
}

Json json_of(const std::vector<SetReport>& reports, const std::string& device) {
    const std::string commit = source_commit();
    Json list = Json::array();
    for (const SetReport& report : reports) {
        list.push_back(json_of(report));
        list.back()["device"] = device;
        list.back()["threads"] = std::thread::hardware_concurrency();
        list.back()["commit"] = commit;
    }
    return list;
}

} // namespace onde::bench
