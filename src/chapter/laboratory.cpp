#include "chapter/laboratory.h"

#include "chapter/random_lines.h"

#include <algorithm>

namespace onde {

namespace {

/// Without a hierarchy every ray tests every triangle: as many rays as this many tests allow.
constexpr uint64_t MOST_FLAT_TESTS = 4'000'000'000;

double median_ns(VolumeTester& tester, VolumeKind kind, const VolumeRays& rays) {
    constexpr uint32_t COPIES = 32;
    constexpr size_t RUNS = 9;
    tester.seconds(kind, rays, COPIES); // warms up
    std::vector<double> seconds;
    for (size_t i = 0; i < RUNS; ++i) seconds.push_back(tester.seconds(kind, rays, COPIES));
    std::ranges::sort(seconds);
    return 1e9 * seconds[RUNS / 2] / (double(rays.size()) * COPIES);
}

} // namespace

LabReport run_laboratory(gpu::Programs& programs, const TriangleSoup& object,
                         const FittedVolumes& volumes, VolumeTester& tester, uint32_t rays) {
    const glm::vec3 center(volumes.sphere.center[0], volumes.sphere.center[1],
                           volumes.sphere.center[2]);
    const std::vector<VolumeRay> lines =
        random_lines(center, 1.5f * volumes.sphere.radius, rays, 1);
    LabReport report{object.triangles.size(), rays};
    report.flat_rays = std::clamp<uint64_t>(MOST_FLAT_TESTS / report.triangles, 64, rays);
    for (const BvhBuilder builder : BUILDERS) {
        const auto some = std::span(lines).first(
            builder == BvhBuilder::none ? size_t(report.flat_rays) : lines.size());
        report.hierarchies.push_back(measure_hierarchy(programs, object, builder, some));
    }
    report.hits = report.hierarchies.back().hits;

    const VolumeRays on_device(programs.device(), lines);
    for (const VolumeKind kind : VOLUME_KINDS) {
        const std::vector<uint32_t> met = tester.met(kind, on_device);
        VolumeReport volume{kind, measure_volume(volumes, kind)};
        volume.rejected = uint64_t(std::ranges::count(met, 0u));
        volume.tests_per_hit =
            (double(rays) + double(rays - volume.rejected) * double(report.triangles)) /
            std::max(double(report.hits), 1.0);
        volume.ns_per_test = median_ns(tester, kind, on_device);
        report.volumes.push_back(volume);
    }
    return report;
}

} // namespace onde
