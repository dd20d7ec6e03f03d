#include "engines_report.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <cstdio>
#include <ctime>

namespace onde::bench {
namespace {

/// Times that of the native tracer.
double speed(const SceneReport& report, const Result& result) {
    return report.results.back().median() / result.median();
}

Json json_of(const Circumstances& c, const SceneReport& report, const Result& r) {
    const double rays = double(r.first.rays);
    Json json = {{"device", c.device},
                 {"commit", c.commit},
                 {"date", c.date},
                 {"width", c.frame.width},
                 {"height", c.frame.height},
                 {"samples", c.frame.samples},
                 {"depth", c.frame.depth},
                 {"native_threads", c.native_threads},
                 {"repetitions", c.repetitions},
                 {"scene", report.scene},
                 {"triangles", report.triangles},
                 {"spheres", report.spheres},
                 {"variant", r.variant},
                 {"settings", r.settings},
                 {"median_seconds", r.median()},
                 {"min_seconds", r.fastest()},
                 {"max_seconds", r.slowest()},
                 {"seconds", r.seconds},
                 {"first_frame_seconds", r.first.seconds},
                 {"mrays_per_second", rays / r.median() * 1e-6},
                 {"mpaths_per_second", c.frame.paths() / r.median() * 1e-6},
                 {"rays_per_path", rays / c.frame.paths()},
                 {"ratio_to_native", speed(report, r)}};
    if (r.variant != NATIVE) json["compile_seconds"] = r.compile_seconds;
    return json;
}

} // namespace

double Result::median() const {
    return bench::median(seconds);
}
double Result::fastest() const {
    return *std::ranges::min_element(seconds);
}
double Result::slowest() const {
    return *std::ranges::max_element(seconds);
}

Circumstances describe_circumstances(const gpu::DeviceFacts& facts, const FrameOptions& frame,
                                     uint32_t native_threads, uint32_t repetitions) {
    const std::string device = fmt::format("{}, {} units, {} ({})", facts.name, facts.compute_units,
                                           facts.platform, facts.driver_version);
    const std::string date = fmt::format("{:%Y-%m-%dT%H:%MZ}", fmt::gmtime(std::time(nullptr)));
    return {device, source_commit(), date, frame, native_threads, repetitions};
}

void print_header(const Circumstances& c) {
    fmt::print(
        "{}\ncommit {}, {}; {}x{}, {} spp, depth {}, box filter, {} repetitions; native: Embree "
        "on {} threads\n",
        c.device, c.commit, c.date, c.frame.width, c.frame.height, c.frame.samples, c.frame.depth,
        c.repetitions, c.native_threads);
    fmt::print("ratio: the native tracer's time over the variant's; compile: kernels, nothing "
               "cached; first: the warm-up frame\n");
}

void print_report(const SceneReport& report, const FrameOptions& frame) {
    fmt::print("\n{}: {} triangles, {} spheres; all pictures of Onde are the same, bit for bit\n",
               report.scene, report.triangles, report.spheres);
    fmt::print("{:<17}{:>10}{:>20}{:>9}{:>10}{:>11}{:>7}{:>11}{:>10}\n", "variant", "median ms",
               "min..max ms", "Mrays/s", "Mpaths/s", "rays/path", "ratio", "compile s", "first ms");
    for (const Result& r : report.results) {
        const double rays = double(r.first.rays);
        const std::string spread =
            fmt::format("{:.1f}..{:.1f}", 1e3 * r.fastest(), 1e3 * r.slowest());
        const std::string compile =
            r.variant == NATIVE ? "-" : fmt::format("{:.2f}", r.compile_seconds);
        fmt::print("{:<17}{:>10.1f}{:>20}{:>9.2f}{:>10.3f}{:>11.3f}{:>7.2f}{:>11}{:>10.1f}\n",
                   r.variant, 1e3 * r.median(), spread, rays / r.median() * 1e-6,
                   frame.paths() / r.median() * 1e-6, rays / frame.paths(), speed(report, r),
                   compile, 1e3 * r.first.seconds);
    }
    std::fflush(stdout);
}

void write_json(const Circumstances& circumstances, const std::vector<SceneReport>& reports,
                const std::filesystem::path& path) {
    Json list = Json::array();
    for (const SceneReport& report : reports)
        for (const Result& result : report.results)
            list.push_back(json_of(circumstances, report, result));
    write_json(list, path);
}

} // namespace onde::bench
