// Passes until the picture has its samples, the time is up, or the user has had enough.
#pragma once

#include "render/integrator.h"

#include <atomic>
#include <functional>

namespace onde {

struct Progress {
    double fraction = 0;       ///< of the samples, or of the time where that is the limit
    double samples = 0;        ///< per pixel so far
    double target_samples = 0; ///< about, where the noise decides
    double seconds = 0;        ///< so far
    double seconds_left = 0;   ///< estimated
    double rays_per_second = 0;
};

struct RenderOutcome {
    double seconds = 0;
    double samples = 0; ///< per pixel, whole unless interrupted
    bool interrupted = false;
};

/// Renders until the integrator's film has the samples options.first_sample to options.samples - 1,
/// or no pixel needs more of them for options.noise, or until options.seconds have passed (checked
/// between passes, so that all pixels have equally many), or until `stop` becomes true (checked
/// between waves). A film that holds samples is continued; the samples of the progress and the
/// outcome are all that it holds. Calls `report` about `reports_per_second` times a second, and at
/// the end.
RenderOutcome render(Integrator& integrator, const RenderOptions& options,
                     const std::atomic<bool>& stop,
                     const std::function<void(const Progress&)>& report,
                     double reports_per_second = 5);

} // namespace onde
