#include "session/findings.h"

#include "render/film_nodes.h"

#include <fmt/format.h>

namespace onde {

std::string clamp_sentence(float clamp, double share) {
    return fmt::format("the clamp at {:g} has cut off {:.3g} % of the light", clamp, 100 * share);
}

std::string noise_sentence(const NoiseReport& report, float target) {
    const std::string samples =
        report.fewest == report.most
            ? fmt::format("{:g} samples of every pixel", report.most)
            : fmt::format("{:g} to {:g} samples of a pixel", report.fewest, report.most);
    if (report.is_met)
        return fmt::format("{}: no more than {:g} % of the pixels are off by more than {:g}",
                           samples, 100 * NOISY_SHARE, target);
    if (report.most < FILM_BLOCK)
        return fmt::format("{}: of fewer than {} it is not known how noisy they are", samples,
                           FILM_BLOCK);
    return fmt::format("{}: some pixels need more; about {:.2g} % are off by more than {:g}",
                       samples, 100 * report.share, target);
}

} // namespace onde
