// One stage kernel at a time on a few hand-made slots of a wave.
#pragma once

#include "kernels/scene_probe.h"
#include "shared/columns.h"

#include <memory>

namespace onde::test {

// The places of columns, from the lists that the kernels use.
#define ONDE_PLACES3(name) name, name##_y, name##_z,
#define ONDE_PLACE1(name) name,
/// Of a path's state, what moves with it; the path's index in the wave is the last.
struct PathColumn {
    enum : uint32_t { PATH_COLUMNS(ONDE_PLACES3, ONDE_PLACE1, ONDE_PLACE1) id, count };
};
/// Of what lasts from one stage to the next: whether a path goes on, its hit, its connection.
struct WorkColumn {
    enum : uint32_t {
        alive,
        HIT_COLUMNS(ONDE_PLACES3, ONDE_PLACE1, ONDE_PLACE1)
            CONNECTION_COLUMNS(ONDE_PLACES3, ONDE_PLACE1, ONDE_PLACE1) count
    };
};
#undef ONDE_PLACES3
#undef ONDE_PLACE1

/// The memory of a wave on the host, and the stages that read and write it. Slots that no path is
/// in are full of NaN. Copies have memory of their own and the same program.
class StageRig {
  public:
    static constexpr uint32_t STRIDE = 64;

    std::vector<float> state = std::vector<float>(PathColumn::count * STRIDE, NAN);
    std::vector<float> next_state = state;
    std::vector<float> work = std::vector<float>(WorkColumn::count * STRIDE, NAN);
    std::vector<glm::vec4> sums = std::vector<glm::vec4>(STRIDE);
    std::vector<uint32_t> counters = std::vector<uint32_t>(COUNTER_SIZE);
    std::vector<uint32_t> invalid = std::vector<uint32_t>(INVALID_SIZE);
    std::vector<uint32_t> queue = {4, 0}; ///< live paths, for steps of either parity
    std::vector<glm::vec4> film;
    std::vector<uint32_t> pixel_order;
    uint32_t count = 4, chunk = 16;
    uint32_t first_pixel = 0, first_sample = 0, log2_samples = 0;

    StageRig(const Scene& scene, uint32_t width, const RenderOptions& options = small_film())
        : film(size_t(options.width) * options.height),
          pixel_order(onde::pixel_order(options.width, options.height)),
          stages_(std::make_shared<Stages>(scene, width, options)) {}

    static RenderOptions small_film() {
        RenderOptions options;
        options.width = options.height = 4;
        options.filter = Filter::box;
        return options;
    }

    float& path(uint32_t k, uint32_t slot) { return state[k * STRIDE + slot]; }
    float& working(uint32_t k, uint32_t slot) { return work[k * STRIDE + slot]; }
    glm::vec3 path3(uint32_t k, uint32_t slot) {
        return {path(k, slot), path(k + 1, slot), path(k + 2, slot)};
    }
    glm::vec3 working3(uint32_t k, uint32_t slot) {
        return {working(k, slot), working(k + 1, slot), working(k + 2, slot)};
    }
    bool is_alive(uint32_t slot) { return from_word(working(WorkColumn::alive, slot)) != 0; }

    /// Puts path `id` into a slot.
    void put_path(uint32_t slot, uint32_t id, glm::vec3 origin, glm::vec3 direction,
                  glm::vec3 throughput = glm::vec3(1), float pdf = 0) {
        put3(state, PathColumn::origin, slot, origin);
        put3(state, PathColumn::direction, slot, direction);
        put3(state, PathColumn::throughput, slot, throughput);
        path(PathColumn::pdf, slot) = pdf;
        path(PathColumn::id, slot) = word(id);
    }
    void put_hit(uint32_t slot, float t, float u, float v, uint32_t primitive) {
        put3(work, WorkColumn::t, slot, {t, u, v});
        working(WorkColumn::primitive, slot) = word(primitive);
        working(WorkColumn::instance, slot) = word(BVH_NONE);
    }
    void put_connection(uint32_t slot, glm::vec3 origin, glm::vec3 direction, float distance,
                        glm::vec3 value) {
        put3(work, WorkColumn::origin, slot, origin);
        put3(work, WorkColumn::direction, slot, direction);
        put3(work, WorkColumn::value, slot, value);
        working(WorkColumn::distance, slot) = distance;
    }

    /// Runs a stage on what the vectors hold and reads back what it left.
    void run(const std::string& stage, uint32_t step = 0) {
        const gpu::Buffer<float> on_state = upload(state), on_next = upload(next_state);
        const gpu::Buffer<float> on_work = upload(work);
        const gpu::Buffer<glm::vec4> on_sums = upload(sums), on_film = upload(film);
        const gpu::Buffer<uint32_t> on_counters = upload(counters), on_invalid = upload(invalid);
        const gpu::Buffer<uint32_t> on_queue = upload(queue), on_order = upload(pixel_order);
        gpu::Kernel& kernel = stages_->program.kernel(stage);
        const uint32_t scene = kernel.set_from(0, count, chunk, first_pixel, first_sample,
                                               log2_samples, step, stages_->world.frame);
        const uint32_t job = stages_->world.scene.bind(kernel, scene);
        kernel.set_from(job, on_counters, on_invalid, on_film, on_order, on_state, on_work, on_sums,
                        STRIDE, on_next, on_queue);
        kernel.launch((count + chunk - 1) / chunk);
        state = on_state.read(device());
        next_state = on_next.read(device());
        work = on_work.read(device());
        sums = on_sums.read(device());
        film = on_film.read(device());
        counters = on_counters.read(device());
        invalid = on_invalid.read(device());
        queue = on_queue.read(device());
    }

    /// Runs the kernel that ends a wave; returns the totals.
    std::vector<uint64_t> tally(const std::vector<uint64_t>& totals) {
        const gpu::Buffer<uint32_t> on_counters = upload(counters);
        const gpu::Buffer<uint64_t> on_totals = upload(totals);
        gpu::Kernel& kernel = stages_->program.kernel("tally");
        kernel.set_from(0, uint32_t(COUNTER_SIZE), on_counters, on_totals);
        kernel.launch(COUNTER_SIZE);
        counters = on_counters.read(device());
        return on_totals.read(device());
    }

  private:
    /// What the rigs of one program share.
    struct Stages {
        SceneOnDevice world;
        gpu::Program program;

        Stages(const Scene& scene, uint32_t width, const RenderOptions& options)
            : world(scene, options),
              program(programs().build(request(world.scene.packed(), width))) {}

        static gpu::ProgramRequest request(const PackedScene& scene, uint32_t width) {
            gpu::ProgramRequest request{"wavefront/staged.cl",
                                        scene.features.defines(),
                                        {},
                                        {layout_file(scene.features.layout), "path/estimator.h"}};
            request.defines.push_back(fmt::format("ONDE_WIDTH={}", width));
            for (const char* name :
                 {"generate", "intersect", "shade", "connect", "extend", "accumulate", "tally"})
                request.kernels.push_back({name, 1});
            return request;
        }
    };

    static void put3(std::vector<float>& columns, uint32_t k, uint32_t slot, glm::vec3 a) {
        for (uint32_t i = 0; i < 3; i++) columns[(k + i) * STRIDE + slot] = a[i];
    }

    template <class T>
    static gpu::Buffer<T> upload(const std::vector<T>& values) {
        gpu::Buffer<T> buffer(device(), values.size());
        buffer.write(device(), std::span<const T>(values));
        return buffer;
    }

    std::shared_ptr<Stages> stages_;
};

} // namespace onde::test
