#include "chapter/volume_trials.h"

#include "chapter/numbers.h"
#include <tbb/parallel_for.h>

#include <cmath>

namespace onde {

namespace {

struct Aimed {
    VolumeRay ray;
    bool hits;
};

class Aim {
  public:
    explicit Aim(const TriangleSoup& object) : object_(object) {
        glm::vec3 low = object.positions[0], high = low;
        for (const glm::vec3& p : object.positions)
            low = glm::min(low, p), high = glm::max(high, p);
        middle_ = 0.5f * (low + high);
        half_ = glm::max(0.5f * (high - low), glm::vec3(1e-3f * glm::length(high - low)));
    }

    Aimed at(uint64_t number) const {
        Numbers numbers(number);
        const glm::uvec3 corners = object_.triangles[numbers.below(object_.triangles.size())];
        const glm::vec3 a = object_.positions[corners.x], b = object_.positions[corners.y];
        const glm::vec3 c = object_.positions[corners.z];
        const VolumeRay ray = toward(numbers, point_of(numbers, a, b, c));
        return {ray, hits(ray, glm::dvec3(a), glm::dvec3(b), glm::dvec3(c))};
    }

  private:
    static glm::vec3 point_of(Numbers& numbers, glm::vec3 a, glm::vec3 b, glm::vec3 c) {
        const uint32_t place = numbers.below(3);
        if (place == 0) return a;
        float u = numbers.unit(), v = place == 1 ? 0.0f : numbers.unit();
        if (u + v > 1) u = 1 - u, v = 1 - v;
        return a + u * (b - a) + v * (c - a);
    }

    VolumeRay toward(Numbers& numbers, glm::vec3 target) const {
        constexpr float DISTANCES[] = {1, 3, 30, 1000};
        const glm::vec3 from = numbers.in_cube();
        const uint32_t way = numbers.below(5);
        if (way < 4) {
            const glm::vec3 origin = middle_ + DISTANCES[way] * half_ * from;
            return {origin, (0.1f + numbers.unit()) * (target - origin)};
        }
        glm::vec3 direction(0.0f);
        const auto axis = glm::length_t(numbers.below(3));
        direction[axis] = numbers.below(2) ? 1.0f : -1.0f;
        return {target - 4.0f * half_[axis] * direction, direction};
    }

    /// Moeller and Trumbore's test in double precision.
    static bool hits(const VolumeRay& ray, glm::dvec3 a, glm::dvec3 b, glm::dvec3 c) {
        const glm::dvec3 direction(ray.direction), s = glm::dvec3(ray.origin) - a;
        const glm::dvec3 p = glm::cross(direction, c - a), q = glm::cross(s, b - a);
        const double determinant = glm::dot(b - a, p);
        if (determinant == 0) return false;
        const double u = glm::dot(s, p) / determinant, v = glm::dot(direction, q) / determinant;
        return u >= 0 && v >= 0 && u + v <= 1 && glm::dot(c - a, q) / determinant >= 0;
    }

    const TriangleSoup& object_;
    glm::vec3 middle_, half_;
};

} // namespace

VolumeTrials try_volumes(const gpu::Device& device, VolumeTester& tester,
                         const TriangleSoup& object, uint64_t rays, uint64_t seed) {
    constexpr uint64_t BATCH = 1u << 19;
    const Aim aim(object);
    VolumeTrials trials;
    std::vector<VolumeRay> batch;
    std::vector<uint8_t> hits;
    for (uint64_t first = 0; first < rays; first += BATCH) {
        const size_t count = std::min(BATCH, rays - first);
        batch.resize(count);
        hits.resize(count);
        tbb::parallel_for(size_t(0), count, [&](size_t i) {
            const Aimed aimed = aim.at((seed << 40) + (first + i) * 0x632be59bd9b4e019u);
            batch[i] = aimed.ray;
            hits[i] = aimed.hits;
        });
        const VolumeRays on_device(device, batch);
        for (size_t kind = 0; kind < VOLUME_KINDS.size(); ++kind) {
            const std::vector<uint32_t> met = tester.met(VOLUME_KINDS[kind], on_device);
            for (size_t i = 0; i < count; ++i) {
                if (!hits[i] || met[i]) continue;
                ++trials.wrongly_rejected[kind];
                trials.worst = batch[i];
            }
        }
        trials.rays += count;
        for (const uint8_t hit : hits) trials.hits += hit;
    }
    return trials;
}

} // namespace onde
