#include "chapter/raster_painter.h"

#include "chapter/raster_sort.h"
#include "chapter/raster_tiles.h"

#include <algorithm>

namespace onde {
namespace {

constexpr uint32_t MOST_SAMPLES = 16; // of one pass

/// Of a tile, for one work item: CPUs take it whole and set up each triangle once.
uint32_t rows_per_item(const gpu::DeviceFacts& facts) {
    return facts.is_cpu ? uint32_t(RASTER_TILE) : 1;
}

size_t shares(size_t count, uint32_t chunk) {
    return (count + chunk - 1) / chunk;
}

struct PainterBuffers {
    TileBuffers tiles;
    SortBuffers sort;
    gpu::Buffer<cl_float4> canvas;
    gpu::Buffer<uint32_t> statistics, keys, order;

    PainterBuffers(RenderBuffers& buffers, const RasterRecord& record,
                   const gpu::DeviceFacts& facts, uint32_t most_entries)
        : tiles(buffers.scene, record, most_entries),
          sort(buffers.scene, facts, record.primitive_count),
          canvas(buffers.film.add<cl_float4>("canvas", size_t(record.width) * record.height)),
          statistics(buffers.film.add_filled("painter statistics", 4, uint32_t(0))),
          keys(buffers.scene.add<uint32_t>("depth keys", record.primitive_count)),
          order(buffers.scene.add<uint32_t>("painting order", record.primitive_count)) {}
};

class TilePainter : public Painter {
  public:
    TilePainter(const IntegratorContext& c, uint32_t most_entries)
        : context_(checked(c)), options_(c.options), buffers_(c.device()), scene_(c, buffers_),
          film_(c.programs, buffers_.film, options_),
          painter_(buffers_, scene_.record(), c.device().facts(), most_entries),
          tiles_(c.device(), painter_.tiles), sort_(c.programs, painter_.sort, scene_.primitives(),
                                                    RadixSort::best_group(c.device().facts())),
          program_(build_raster(c, "painter.cl",
                                {{"depth_keys", shares(scene_.primitives(), chunk())},
                                 {"find_tiles", shares(scene_.primitives(), chunk())},
                                 {"count_tiles", tiles_.most_blocks()},
                                 {"scan_columns", tiles_.count()},
                                 {"fill_tiles", tiles_.most_blocks()},
                                 {"clear_canvas", shares(pixels(), chunk())},
                                 {"paint_tiles", paint_items()},
                                 {"resolve_canvas", shares(pixels(), chunk())}})) {
        report_ = program_.report();
        report_.seconds += sort_.build_report().seconds;
        report_.from_cache &= sort_.build_report().from_cache;
    }

    void render_pass(uint32_t first, uint32_t count,
                     const std::function<bool(double)>& keep_going) override {
        if (!sorted_) sort();
        for (uint32_t sample = 0; sample < count; sample++) {
            scene_.set_sample(first + sample);
            const auto between = [&] { return keep_going(double(sample) / count); };
            film_.begin_pass(first + sample, 1, pixels());
            if (!draw_sample(between)) return;
            film_.end_wave(pixels());
            if (!keep_going(double(sample + 1) / count)) return;
        }
    }

    uint32_t max_samples() const override { return MOST_SAMPLES; }
    void clear() override {
        painter_.statistics.fill(context_.device(), 0u);
        film_.clear();
    }
    Film& film() override { return film_; }
    RayCounts ray_counts() const override { return {}; }
    const gpu::BuildReport& build_report() const override { return report_; }
    const RenderBuffers& buffers() const override { return buffers_; }

    PaintCounts counts() const override {
        const std::vector<uint32_t> words = painter_.statistics.read(context_.device());
        return {uint64_t(words[1]) << 32 | words[0], uint64_t(words[3]) << 32 | words[2]};
    }

    std::vector<std::string> findings() const override {
        std::vector<std::string> sentences = scene_.notes();
        const PaintCounts c = counts();
        if (c.covered > 0)
            sentences.push_back(fmt::format(
                "{} fragments were painted on {} covered samples of pixels: {:.3g} for each",
                c.fragments, c.covered, double(c.fragments) / double(c.covered)));
        return sentences;
    }

  private:
    static const IntegratorContext& checked(const IntegratorContext& context) {
        check_options(context.options);
        return context;
    }
    uint32_t pixels() const { return options_.width * options_.height; }
    uint32_t chunk() const { return options_.settings.chunk; }
    uint32_t rows() const { return rows_per_item(context_.device().facts()); }
    uint32_t paint_items() const { return tiles_.count() * (uint32_t(RASTER_TILE) / rows()); }

    /// The order does not depend on the sample.
    void sort() {
        gpu::Kernel& kernel = program_.kernel("depth_keys");
        kernel.set_from(0, scene_.primitives(), chunk());
        kernel.set_from(scene_.bind(kernel, 2), painter_.keys, painter_.order);
        kernel.launch(shares(scene_.primitives(), chunk()), context_.profiler);
        sort_.sort(painter_.keys, painter_.order, scene_.primitives(), context_.profiler);
        sorted_ = true;
    }

    /// Returns whether it was drawn to its end; else it is not on the film.
    bool draw_sample(const std::function<bool()>& keep_going) {
        gpu::Kernel& clear = program_.kernel("clear_canvas");
        clear.set_from(0, pixels(), chunk());
        clear.set_from(scene_.bind(clear, 2), painter_.canvas);
        clear.launch(shares(pixels(), chunk()), context_.profiler);
        tiles_.find(program_, scene_, chunk(), context_.profiler);
        for (uint32_t first = 0; first < scene_.primitives();) {
            first += tiles_.list(program_, painter_.order, first, scene_.primitives() - first,
                                 context_.profiler);
            paint();
            if (!keep_going()) return false;
        }
        gpu::Kernel& resolve = program_.kernel("resolve_canvas");
        resolve.set_from(0, pixels(), chunk(), painter_.canvas, film_.sums(), painter_.statistics);
        resolve.launch(shares(pixels(), chunk()), context_.profiler);
        context_.device().finish();
        return true;
    }

    void paint() {
        gpu::Kernel& kernel = program_.kernel("paint_tiles");
        kernel.set(0, paint_items());
        const uint32_t next = kernel.set_from(scene_.bind_scene(kernel, 1), rows());
        kernel.set_from(scene_.bind(kernel, next), tiles_.across(), tiles_.begins(), tiles_.lists(),
                        painter_.canvas);
        kernel.launch(paint_items(), context_.profiler);
        context_.device().finish();
    }

    IntegratorContext context_;
    RenderOptions options_;
    RenderBuffers buffers_;
    RasterScene scene_;
    Film film_;
    PainterBuffers painter_;
    RasterTiles tiles_;
    RadixSort sort_;
    gpu::Program program_;
    gpu::BuildReport report_;
    bool sorted_ = false;
};

} // namespace

void plan_painter(RenderBuffers& buffers, const Scene& scene, const RenderOptions& options,
                  const gpu::DeviceFacts& facts) {
    const PackedRaster packed = pack_raster(scene, scene.cameras.at(options.camera), options);
    RasterBuffers(buffers.scene, packed);
    PainterBuffers(buffers, packed.record, facts, MOST_TILE_ENTRIES);
}

std::unique_ptr<Painter> make_painter(const IntegratorContext& context, uint32_t most_entries) {
    return std::make_unique<TilePainter>(context, most_entries);
}

} // namespace onde
