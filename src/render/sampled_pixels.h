// Which pixels get the next samples: all, or where the options have a noise target, those that are
// not sure yet to be within it.
//
// That is decided from the sums of whole blocks alone, where a film has 1, 2, 3, 4, 6, 8, 12, ...
// of them: the picture is a function of scene, options and seed, however it was interrupted.
#pragma once

#include "render/integrator.h"
#include "render/noise.h"

#include <optional>

namespace onde {

/// What is known of the noise of a film with halves, from its whole blocks.
struct NoiseReport {
    double share = 0; ///< of the pixels that are off by more than the target, roughly: pixels that
                      ///< are done seem less noisy than they are
    bool is_met = false;         ///< no pixel that got the most samples needs more
    double fewest = 0, most = 0; ///< samples of a pixel
};

NoiseReport noise_report(const Film& film, const RenderOptions& options);

class SampledPixels {
  public:
    /// Both outlive it. Goes on with whatever samples the integrator's film has.
    SampledPixels(Integrator& integrator, const RenderOptions& options);

    /// To be called before each pass: chooses. False where no pixel needs more samples.
    bool choose();

    /// Per pixel, on average: of the film, and about at the end.
    double samples() const;
    double samples_at_end() const;

  private:
    void choose_from(uint32_t blocks);

    Integrator& integrator_;
    const RenderOptions& options_;
    std::vector<uint32_t> pixels_;   ///< that get samples, as set_pixels() takes them
    size_t all_;                     ///< pixels of the picture
    std::optional<uint32_t> blocks_; ///< of the film, when they were chosen
    double had_ = 0, needs_ = 0;     ///< samples of all pixels then, and about how many more
};

} // namespace onde
