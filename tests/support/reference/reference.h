// An independent path tracer over Embree: the oracle of the image tests and the native competitor
// of the benches. Written from scene.h and the literature; it shares no code with kernels/.
#pragma once

#include "scene/scene.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace onde {

/// How light from area lights and the environment is found. All have the same expected value; the
/// last two exist so that a test can say so.
enum class Technique : uint32_t {
    mis,        ///< light and BSDF sampling, power heuristic
    light_only, ///< light sampling alone; only delta lobes find lights by being sampled
    bsdf_only,  ///< BSDF sampling alone; point and directional lights are still sampled
};

struct ReferenceOptions {
    uint32_t width = 64;
    uint32_t height = 64;
    uint32_t samples = 64; ///< per pixel
    /// The most surface vertices a path may visit. Emission of the last one counts, and nothing
    /// beyond it: 1 shows emitters only, 2 adds direct light.
    uint32_t depth = 8;
    uint32_t roulette_start = 4; ///< first vertex (from 0) at which Russian roulette applies
    uint32_t seed = 0;
    uint32_t threads = 2;
    uint32_t camera = 0; ///< index into Scene::cameras
    Filter filter = Filter::box;
    Technique technique = Technique::mis;
};

/// Pixels are row by row from the top.
struct ReferenceResult {
    uint32_t width = 0, height = 0, samples = 0;
    std::vector<glm::vec3> mean;             ///< radiance per pixel
    std::vector<glm::vec3> variance_of_mean; ///< estimated from the samples; 0 for a single one
    double seconds = 0.0;                    ///< of the rendering alone, without any building
    uint64_t extension_rays = 0;             ///< closest-hit queries
    uint64_t shadow_rays = 0;                ///< any-hit queries
    uint64_t invalid_samples = 0;            ///< not finite; counted as black
};

/// Holds its own copy of everything it needs of the scene.
class ReferenceRenderer {
  public:
    /// Builds the Embree scene. The scene satisfies check_scene().
    explicit ReferenceRenderer(const Scene& scene);
    ~ReferenceRenderer();

    /// The same options give the same pixels, whatever the number of threads. Throws InputError
    /// when the options name no pixel, no sample, no thread or a camera that does not exist.
    ReferenceResult render(const ReferenceOptions& options) const;

  private:
    struct World;
    std::unique_ptr<World> world_;
};

} // namespace onde
