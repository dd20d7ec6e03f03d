#include "render/whitted_engine.h"

#include "render/tree_memory.h"

#include <algorithm>
#include <optional>

namespace onde {
namespace {

const std::vector<std::string> STAGES{"tree_begin",          "tree_generate_rays",
                                      "tree_intersect_rays", "tree_shade_hits",
                                      "tree_resolve_level",  "tree_accumulate_paths"};

/// Ways to do the paths of a wave, in the order in which they are tried: what one of them leaves
/// unfinished, because its memory is too small for the trees, the next one does.
enum class Way { staged, fused, megakernel };

class WhittedEngine : public EngineDriver {
  public:
    WhittedEngine(const EngineContext& context, const Scene& scene)
        : context_(context), packed_(pack_whitted(scene, context.options.depth)),
          arguments_(context), memory_(context.buffers.paths, context.options, packed_),
          first_way_(first_way(context.options)), program_(build(first_way_)) {}

    void render_wave(const Wave& wave) override {
        memory_.begin(program_, wave.paths());
        run(first_way_, program_, wave);
        for (Way way = next(first_way_); memory_.is_unfinished(context_.device(), wave.paths());
             way = next(way))
            run(way, fallback(way), wave);
        arguments_.tally(program_, context_.profiler);
    }

    uint32_t wave_capacity() const override { return settings().wave_size; }
    uint32_t sample_capacity() const override { return settings().chunk; }
    std::vector<uint64_t> counters() const override { return arguments_.counters(); }
    const gpu::BuildReport& build_report() const override { return program_.report(); }

  private:
    static Way first_way(const RenderOptions& options) {
        if (options.engine == Engine::megakernel) return Way::megakernel;
        return options.settings.launch == gpu::Launch::fused ? Way::fused : Way::staged;
    }
    static Way next(Way way) { return way == Way::staged ? Way::fused : Way::megakernel; }

    const gpu::DeviceSettings& settings() const { return context_.options.settings; }

    gpu::Program build(Way way) const {
        switch (way) {
        case Way::staged:
            return build_engine(context_, "wavefront/tree_staged.cl", STAGES, packed_.defines());
        case Way::fused:
            return build_engine(context_, "wavefront/tree_fused.cl", {"tree_begin", "tree_fused"},
                                packed_.defines());
        default:
            return build_engine(context_, "megakernel/tree_megakernel.cl",
                                {"tree_begin", "tree_megakernel"}, packed_.defines());
        }
    }

    /// Compiled when it is first needed.
    gpu::Program& fallback(Way way) {
        std::optional<gpu::Program>& program = fallbacks_[way == Way::fused ? 0 : 1];
        if (!program) program = build(way);
        return *program;
    }

    void run(Way way, gpu::Program& program, const Wave& wave) {
        if (way == Way::fused) return launch(program, "tree_fused", wave, 0);
        if (way == Way::megakernel) return launch(program, "tree_megakernel", wave, 0);
        launch(program, "tree_generate_rays", wave, 0);
        const uint32_t depth = packed_.settings.max_depth;
        for (uint32_t level = 0; level < depth; level++) {
            launch(program, "tree_intersect_rays", wave, level);
            launch(program, "tree_shade_hits", wave, level);
        }
        for (uint32_t level = depth - 1; level > 0; level--)
            launch(program, "tree_resolve_level", wave, level);
        launch(program, "tree_accumulate_paths", wave, 0);
    }

    void launch(gpu::Program& program, const char* name, const Wave& wave, uint32_t level) {
        gpu::Kernel& kernel = program.kernel(name);
        memory_.bind(kernel, arguments_.bind(kernel), level);
        arguments_.set_wave(kernel, wave, settings().chunk);
        kernel.launch((wave.paths() + settings().chunk - 1) / settings().chunk, context_.profiler);
    }

    EngineContext context_;
    PackedWhitted packed_;
    KernelArguments arguments_;
    TreeMemory memory_;
    Way first_way_;
    gpu::Program program_;
    std::optional<gpu::Program> fallbacks_[2];
};

} // namespace

void plan_whitted_engine(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options) {
    JobBuffers(buffers.film, options);
    TreeMemory(buffers.paths, options, pack_whitted(scene, options.depth));
}

std::unique_ptr<EngineDriver> make_whitted_engine(const EngineContext& context,
                                                  const Scene& scene) {
    return std::make_unique<WhittedEngine>(context, scene);
}

} // namespace onde
