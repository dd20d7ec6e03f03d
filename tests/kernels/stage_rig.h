// One stage kernel at a time on a few hand-made slots of a wave.
#pragma once

#include "kernels/scene_probe.h"

#include <memory>

namespace onde::test {

/// Lanes of a path's state and of its shadow ray, as in kernels/wavefront/state.h.
enum Lane : uint32_t {
    ORIGIN = 0,
    PDF = 3,
    DIRECTION = 4,
    ID = 7,
    THROUGHPUT = 8,
    ALIVE = 11,
    HIT_T = 12,
    HIT_PRIMITIVE = 15,
    HIT_INSTANCE = 16,
    STATE_LANES = 17,
};
enum ShadowLane : uint32_t {
    SHADOW_ORIGIN = 0,
    SHADOW_DISTANCE = 3,
    SHADOW_DIRECTION = 4,
    SHADOW_RADIANCE = 7,
    SHADOW_LANES = 10,
};

/// The memory of a wave on the host, and the stages that read and write it. Slots that no path is
/// in are full of NaN. Copies have memory of their own and the same program.
class StageRig {
  public:
    static constexpr uint32_t STRIDE = 64;

    std::vector<float> state = std::vector<float>(STATE_LANES * STRIDE, NAN);
    std::vector<float> next_state = state;
    std::vector<float> shadow = std::vector<float>(SHADOW_LANES * STRIDE, NAN);
    std::vector<glm::vec4> radiance = std::vector<glm::vec4>(STRIDE);
    std::vector<uint32_t> counters = std::vector<uint32_t>(COUNTER_SIZE);
    std::vector<uint32_t> invalid = std::vector<uint32_t>(INVALID_SIZE);
    std::vector<uint32_t> live;
    std::vector<glm::vec4> film;
    std::vector<uint32_t> pixel_order;
    uint32_t count = 4, chunk = 16;
    uint32_t first_pixel = 0, first_sample = 0, log2_samples = 0;

    StageRig(const Scene& scene, uint32_t width, bool global_queue = false,
             const RenderOptions& options = small_film())
        : live(STRIDE), film(size_t(options.width) * options.height),
          pixel_order(onde::pixel_order(options.width, options.height)),
          stages_(std::make_shared<Stages>(scene, width, global_queue, options)) {}

    static RenderOptions small_film() {
        RenderOptions options;
        options.width = options.height = 4;
        options.filter = Filter::box;
        return options;
    }

    float& lane(uint32_t k, uint32_t slot) { return state[k * STRIDE + slot]; }
    float& shadow_lane(uint32_t k, uint32_t slot) { return shadow[k * STRIDE + slot]; }
    glm::vec3 lanes3(uint32_t k, uint32_t slot) {
        return {lane(k, slot), lane(k + 1, slot), lane(k + 2, slot)};
    }
    glm::vec3 shadow3(uint32_t k, uint32_t slot) {
        return {shadow_lane(k, slot), shadow_lane(k + 1, slot), shadow_lane(k + 2, slot)};
    }

    /// Puts path `id` into a slot.
    void put_path(uint32_t slot, uint32_t id, glm::vec3 origin, glm::vec3 direction,
                  glm::vec3 throughput = glm::vec3(1), float pdf = 0) {
        put3(state, ORIGIN, slot, origin);
        put3(state, DIRECTION, slot, direction);
        put3(state, THROUGHPUT, slot, throughput);
        lane(PDF, slot) = pdf;
        lane(ID, slot) = word(id);
    }
    void put_hit(uint32_t slot, float t, float u, float v, uint32_t primitive) {
        put3(state, HIT_T, slot, {t, u, v});
        lane(HIT_PRIMITIVE, slot) = word(primitive);
        lane(HIT_INSTANCE, slot) = word(BVH_NONE);
    }
    void put_shadow_ray(uint32_t slot, glm::vec3 origin, glm::vec3 direction, float distance,
                        glm::vec3 light) {
        put3(shadow, SHADOW_ORIGIN, slot, origin);
        put3(shadow, SHADOW_DIRECTION, slot, direction);
        put3(shadow, SHADOW_RADIANCE, slot, light);
        shadow_lane(SHADOW_DISTANCE, slot) = distance;
    }

    /// Runs a stage on what the vectors hold and reads back what it left.
    void run(const std::string& stage, uint32_t bounce = 0) {
        const gpu::Buffer<float> on_state = upload(state), on_next = upload(next_state);
        const gpu::Buffer<float> on_shadow = upload(shadow);
        const gpu::Buffer<glm::vec4> on_radiance = upload(radiance), on_film = upload(film);
        const gpu::Buffer<uint32_t> on_counters = upload(counters), on_invalid = upload(invalid);
        const gpu::Buffer<uint32_t> on_live = upload(live), on_order = upload(pixel_order);
        gpu::Kernel& kernel = stages_->program.kernel(stage);
        kernel.set_from(0, count, stages_->world.frame);
        const uint32_t job = stages_->world.scene.bind(kernel, 2);
        const uint32_t wave = kernel.set_from(job, on_counters, on_invalid, on_film, on_order,
                                              chunk, first_pixel, first_sample, log2_samples);
        kernel.set_from(wave, on_state, on_next, on_shadow, on_radiance, STRIDE, on_live, bounce);
        kernel.launch((count + chunk - 1) / chunk);
        state = on_state.read(device());
        next_state = on_next.read(device());
        shadow = on_shadow.read(device());
        radiance = on_radiance.read(device());
        film = on_film.read(device());
        counters = on_counters.read(device());
        invalid = on_invalid.read(device());
        live = on_live.read(device());
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

        Stages(const Scene& scene, uint32_t width, bool global_queue, const RenderOptions& options)
            : world(scene, options),
              program(programs().build(request(world.scene.packed(), width, global_queue))) {}

        static gpu::ProgramRequest request(const PackedScene& scene, uint32_t width, bool global) {
            gpu::ProgramRequest request{"wavefront/staged.cl", scene.features.defines(), {}};
            request.defines.push_back(fmt::format("ONDE_WIDTH={}", width));
            request.defines.push_back(fmt::format("ONDE_GLOBAL_QUEUE={:d}", global));
            for (const char* name :
                 {"generate", "intersect", "shade", "shadow_test", "extend", "accumulate", "tally"})
                request.kernels.push_back({name, 1});
            return request;
        }
    };

    static void put3(std::vector<float>& lanes, uint32_t k, uint32_t slot, glm::vec3 a) {
        for (uint32_t i = 0; i < 3; i++) lanes[(k + i) * STRIDE + slot] = a[i];
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
