// How noisy pictures are that differ in their seeds alone.
#pragma once

#include "core/command_line.h"
#include "session/machine.h"
#include "session/session.h"

namespace onde::bench {

struct Variance {
    double mean = 0;    ///< of all pictures
    double all = 0;     ///< variance over (mean^2 + 0.01), the mean over pixels
    double trimmed = 0; ///< without the worst thousandth of the pixels
    double seconds = 0; ///< of a picture, the least
};

/// Of pictures of seeds 1 to `seeds`, whose options are otherwise the session's.
Variance variance_over_seeds(Session& session, uint32_t seeds);

/// A session of a path-traced picture that samples lights as the options say.
struct VarianceOptions {
    std::string device, kernels;
    uint32_t width = 160, height = 120, samples = 16, seeds = 8;
};
void add_variance(Command& command, VarianceOptions& options);
Session variance_session(Machine& machine, const Scene& scene, const VarianceOptions& options,
                         const LightOptions& lights);

} // namespace onde::bench
