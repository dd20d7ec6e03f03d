#include "support/reference/reference.h"

#include "core/error.h"
#include "core/timer.h"
#include "support/reference/path.h"

#include <atomic>
#include <thread>

namespace onde {

using namespace reference;

struct ReferenceRenderer::World {
    Geometry geometry;
    Appearance appearance;
    Lights lights;
    std::vector<Camera> cameras;

    explicit World(const Scene& scene)
        : geometry(scene), appearance(scene), lights(scene, geometry, appearance),
          cameras(scene.cameras) {}
};

namespace {

constexpr uint32_t TILE = 16;

struct Statistics {
    glm::dvec3 sum{0.0}, sum_of_squares{0.0};

    void add(const glm::dvec3& x) {
        sum += x;
        sum_of_squares += x * x;
    }
    glm::dvec3 mean(uint32_t n) const { return sum / double(n); }
    glm::dvec3 variance_of_mean(uint32_t n) const {
        if (n < 2) return glm::dvec3(0.0);
        const glm::dvec3 m = mean(n);
        return glm::max(sum_of_squares / double(n) - m * m, 0.0) / double(n - 1);
    }
};

struct WorkerCounts {
    RayCounts rays;
    uint64_t invalid = 0;
};

/// One frame in the making; tiles are handed out to whoever asks.
class FrameJob {
  public:
    FrameJob(const PathTracer& tracer, const PinholeOrLens& camera, const ReferenceOptions& options,
             ReferenceResult& result)
        : tracer_(tracer), camera_(camera), options_(options), result_(result),
          tiles_x_((options.width + TILE - 1) / TILE),
          tile_count_(tiles_x_ * ((options.height + TILE - 1) / TILE)) {}

    WorkerCounts work() {
        WorkerCounts counts;
        for (uint32_t tile; (tile = next_tile_++) < tile_count_;) render_tile(tile, counts);
        return counts;
    }

  private:
    void render_tile(uint32_t tile, WorkerCounts& counts) {
        const uint32_t left = tile % tiles_x_ * TILE, top = tile / tiles_x_ * TILE;
        for (uint32_t y = top; y < std::min(top + TILE, options_.height); ++y)
            for (uint32_t x = left; x < std::min(left + TILE, options_.width); ++x)
                render_pixel(x, y, counts);
    }

    void render_pixel(uint32_t x, uint32_t y, WorkerCounts& counts) {
        const uint32_t pixel = y * options_.width + x;
        Statistics statistics;
        for (uint32_t i = 0; i < options_.samples; ++i) {
            Random random(options_.seed, pixel, i);
            const Ray ray = camera_.sample(x, y, random);
            const glm::dvec3 radiance(tracer_.radiance(ray, random, counts.rays));
            if (std::isfinite(radiance.x + radiance.y + radiance.z))
                statistics.add(radiance);
            else
                ++counts.invalid;
        }
        result_.mean[pixel] = glm::vec3(statistics.mean(options_.samples));
        result_.variance_of_mean[pixel] = glm::vec3(statistics.variance_of_mean(options_.samples));
    }

    const PathTracer& tracer_;
    const PinholeOrLens& camera_;
    const ReferenceOptions& options_;
    ReferenceResult& result_;
    uint32_t tiles_x_, tile_count_;
    std::atomic<uint32_t> next_tile_ = 0;
};

void check_options(const ReferenceOptions& o, size_t cameras) {
    if (o.width == 0 || o.height == 0 || o.samples == 0 || o.threads == 0)
        throw InputError("The reference cannot render {}x{} pixels of {} samples on {} threads: "
                         "each must be at least 1.",
                         o.width, o.height, o.samples, o.threads);
    if (o.camera >= cameras)
        throw InputError("The reference was asked for camera {} of a scene that has {}.", o.camera,
                         cameras);
}

} // namespace

ReferenceRenderer::ReferenceRenderer(const Scene& scene) : world_(std::make_unique<World>(scene)) {}

ReferenceRenderer::~ReferenceRenderer() = default;

ReferenceResult ReferenceRenderer::render(const ReferenceOptions& options) const {
    check_options(options, world_->cameras.size());
    ReferenceResult result;
    result.width = options.width, result.height = options.height, result.samples = options.samples;
    result.mean.resize(size_t(options.width) * options.height);
    result.variance_of_mean.resize(result.mean.size());
    const PathTracer tracer(world_->geometry, world_->appearance, world_->lights, options);
    const PinholeOrLens camera(world_->cameras[options.camera], options.width, options.height,
                               options.filter);
    const Timer timer;
    FrameJob job(tracer, camera, options, result);
    std::vector<WorkerCounts> counts(options.threads);
    {
        std::vector<std::jthread> workers;
        for (WorkerCounts& mine : counts) workers.emplace_back([&] { mine = job.work(); });
    }
    result.seconds = timer.seconds();
    for (const WorkerCounts& c : counts) {
        result.extension_rays += c.rays.extension;
        result.shadow_rays += c.rays.shadow;
        result.invalid_samples += c.invalid;
    }
    return result;
}

} // namespace onde
