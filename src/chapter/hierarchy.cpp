#include "chapter/hierarchy.h"

#include "core/timer.h"
#include "upload/device_bvh.h"

#include <algorithm>

namespace onde {

namespace {

constexpr size_t LOCAL_SIZE = 64, RUNS = 5;

/// As trace/query.cl reads it.
struct TracedRay {
    glm::vec3 origin;
    float t_min;
    glm::vec3 direction;
    float t_max;
};
static_assert(sizeof(TracedRay) == 32);

std::vector<TracedRay> traced(std::span<const VolumeRay> rays) {
    std::vector<TracedRay> all;
    for (const VolumeRay& ray : rays) all.push_back({ray.origin, 0.0f, ray.direction, 1e30f});
    return all;
}

std::vector<std::string> defines(const Bvh& bvh) {
    return {fmt::format("ONDE_STACK_SIZE={}", std::max(64u, (bvh.stack_size + 31) / 32 * 32)),
            "ONDE_INSTANCES=0", "ONDE_SPHERES=0"};
}

/// A tree on the device, and rays for it.
class TreeOnDevice {
  public:
    TreeOnDevice(const gpu::Device& device, const Bvh& bvh, std::span<const VolumeRay> rays)
        : device_(device), tree_(device, bvh), count_(rays.size()),
          rays_(device, std::span<const TracedRay>(traced(rays))) {}

    template <class T>
    void trace(gpu::Kernel& kernel, const gpu::Buffer<T>& results) const {
        kernel.set_from(0, uint32_t(count_));
        kernel.set_from(tree_.bind(kernel, 1), rays_, results);
        kernel.launch(count_);
        device_.finish();
    }

  private:
    const gpu::Device& device_;
    DeviceBvh tree_;
    size_t count_;
    gpu::Buffer<TracedRay> rays_;
};

} // namespace

const char* builder_name(BvhBuilder builder) {
    switch (builder) {
    case BvhBuilder::none:
        return "none";
    case BvhBuilder::median:
        return "median";
    case BvhBuilder::median_spatial:
        return "median, spatial cuts";
    case BvhBuilder::high:
        return "SAH, spatial splits";
    case BvhBuilder::sah:
        break;
    }
    return "SAH, 16 wide";
}

HierarchyReport measure_hierarchy(gpu::Programs& programs, const TriangleSoup& object,
                                  BvhBuilder builder, std::span<const VolumeRay> rays) {
    const gpu::Device& device = programs.device();
    const Geometry geometry{object.positions, object.triangles, {}, 0};
    const Placement placement;
    const Bvh bvh = build_bvh({&geometry, 1}, {&placement, 1}, {.builder = builder});
    const TreeOnDevice tree(device, bvh, rays);
    HierarchyReport report{bvh.statistics, rays.size()};

    gpu::ProgramRequest counting{
        "chapter/traversal_cost.cl", defines(bvh), {}, {layout_file(bvh.layout)}};
    counting.defines.push_back("ONDE_TRAVERSAL_COST=1");
    counting.kernels.push_back({"count_tests", LOCAL_SIZE, rays.size()});
    gpu::Program counter = programs.build(counting);
    const gpu::Buffer<uint32_t> tests(device, 3 * rays.size());
    tree.trace(counter.kernel("count_tests"), tests);
    const std::vector<uint32_t> counts = tests.read(device);
    for (size_t i = 0; i < rays.size(); ++i) {
        if (builder != BvhBuilder::none) report.boxes += counts[3 * i];
        report.triangles += counts[3 * i + 1];
        report.hits += counts[3 * i + 2];
    }

    const uint32_t group = device.facts().tracing_group();
    gpu::Program tracer =
        programs.build({"trace/query.cl",
                        defines(bvh),
                        {{"closest", group, rays.size()}, {"occluded", group, rays.size()}},
                        {layout_file(bvh.layout)}});
    const gpu::Buffer<uint32_t> hits(device, 5 * rays.size());
    std::vector<double> seconds;
    for (size_t i = 0; i < RUNS; ++i) {
        const Timer timer;
        tree.trace(tracer.kernel("closest"), hits);
        seconds.push_back(timer.seconds());
    }
    std::ranges::sort(seconds);
    report.seconds = seconds[RUNS / 2];
    return report;
}

} // namespace onde
