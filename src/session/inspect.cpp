#include "session/inspect.h"

#include "chapter/whitted_estimator.h"
#include "core/error.h"
#include "render/frame.h"
#include "shared/columns.h"

#include <algorithm>

namespace onde {
namespace {

constexpr uint32_t MOST_NODES = 1u << 16;

/// The options of a wave that is one path of width 1.
RenderOptions single_path(RenderOptions options) {
    options.settings.width = options.settings.chunk = options.settings.wave_size = 1;
    options.settings.local_size = 1;
    options.settings.launch = gpu::Launch::fused;
    options.engine = Engine::wavefront;
    options.aovs = 0;
    options.ids = false;
    options.light_groups.clear();
    options.samples = options.samples_in_flight = 1;
    return options;
}

Wave wave_of(const RenderOptions& options, const PixelSample& at) {
    if (at.x >= options.width || at.y >= options.height)
        throw InputError("pixel {},{} lies outside the picture, which is {}x{}", at.x, at.y,
                         options.width, options.height);
    const std::vector<uint32_t> order = pixel_order(options.width, options.height);
    const auto place = std::ranges::find(order, at.x | at.y << 16);
    return {uint32_t(place - order.begin()), 1, at.sample, 1};
}

/// A program of one kernel that is run once, on one work item, for one path.
class Inspection {
  public:
    Inspection(const IntegratorContext& c, const PixelSample& at)
        : device_(c.device()), options_(single_path(c.options)), wave_(wave_of(options_, at)),
          buffers_(c.device()),
          film_(c.programs, buffers_.film, options_), engine_{c.programs, buffers_, c.scene, film_,
                                                              c.camera,   options_, nullptr},
          arguments_(engine_) {}

    const RenderOptions& options() const { return options_; }
    RenderBuffers& buffers() { return buffers_; }

    gpu::Program build(const EstimatorShape& estimator, const std::string& file,
                       const std::string& kernel) const {
        return build_engine(engine_, estimator, file, {kernel});
    }
    /// Binds what all kernels share; returns the first index after it.
    uint32_t bind(gpu::Kernel& kernel) const {
        const uint32_t next = arguments_.bind(kernel);
        arguments_.set_wave(kernel, wave_, 1);
        return next;
    }
    void run(gpu::Kernel& kernel) const {
        kernel.launch(1);
        device_.finish();
    }

  private:
    const gpu::Device& device_;
    RenderOptions options_;
    Wave wave_;
    RenderBuffers buffers_;
    Film film_;
    EngineContext engine_;
    KernelArguments arguments_;
};

} // namespace

TreeReport inspect_whitted(const IntegratorContext& c, const PixelSample& at) {
    // TreeNode of kernels/inspect/whitted.cl: a ray and its hit.
    constexpr size_t NODE_WORDS = COLUMN_COUNT(WHITTED_COLUMNS) + COLUMN_COUNT(HIT_COLUMNS);
    Inspection inspection(c, at);
    const WhittedEstimator estimator(inspection.buffers(), *c.description, inspection.options());
    gpu::Program program =
        inspection.build(estimator.shape(), "inspect/whitted.cl", "inspect_whitted");
    gpu::Kernel& kernel = program.kernel("inspect_whitted");

    const uint32_t sources = estimator.sources();
    const gpu::Buffer<float> tree(c.device(), MOST_NODES * NODE_WORDS);
    const gpu::Buffer<NodeReport> nodes(c.device(), MOST_NODES);
    const gpu::Buffer<SourceReport> lights(c.device(), size_t(MOST_NODES) * sources);
    const gpu::Buffer<uint32_t> count(c.device(), 1);
    const uint32_t next = estimator.bind(kernel, inspection.bind(kernel));
    kernel.set_from(next, tree, nodes, lights, MOST_NODES, count);
    inspection.run(kernel);

    TreeReport report;
    const uint32_t found = count.read(c.device())[0];
    if (found == 0)
        throw InputError("the ray tree of this pixel has more than {} nodes; use a smaller --depth",
                         MOST_NODES);
    report.nodes = nodes.read(c.device(), 0, found);
    for (uint32_t i = 0; i < found; i++) {
        const bool lit = report.nodes[i].alive && report.nodes[i].hit.primitive != BVH_NONE;
        report.sources.push_back(lit && sources
                                     ? lights.read(c.device(), size_t(i) * sources, sources)
                                     : std::vector<SourceReport>());
    }
    return report;
}

PathReport inspect_path(const IntegratorContext& c, const PixelSample& at) {
    const Inspection inspection(c, at);
    const PathEstimator estimator(inspection.options(), c.scene.packed().features);
    gpu::Program program = inspection.build(estimator.shape(), "inspect/path.cl", "inspect_path");
    gpu::Kernel& kernel = program.kernel("inspect_path");
    const gpu::Buffer<BounceReport> bounces(c.device(), c.options.depth);
    const gpu::Buffer<uint32_t> count(c.device(), 1);
    const gpu::Buffer<float> radiance(c.device(), 3);
    kernel.set_from(inspection.bind(kernel), bounces, count, radiance);
    inspection.run(kernel);
    const std::vector<float> sum = radiance.read(c.device());
    return {bounces.read(c.device(), 0, count.read(c.device())[0]), {sum[0], sum[1], sum[2]}};
}

} // namespace onde
