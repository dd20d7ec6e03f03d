#include "render/render_loop.h"

#include "core/timer.h"
#include "render/sampled_pixels.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

/// Decides when to report, and what.
class Reporter {
  public:
    Reporter(Integrator& integrator, const SampledPixels& pixels, const RenderOptions& options,
             const std::function<void(const Progress&)>& report, double per_second)
        : integrator_(integrator), pixels_(pixels), options_(options), report_(report),
          interval_(1 / per_second), begun_(pixels.samples()) {}

    double seconds() const { return timer_.seconds(); }

    void wave_done(bool always = false) {
        const double now = timer_.seconds();
        if (!always && now < next_) return;
        next_ = now + interval_;
        Progress progress;
        progress.samples = pixels_.samples();
        progress.target_samples = pixels_.samples_at_end();
        progress.seconds = now;
        const double by_samples = progress.samples / progress.target_samples;
        const double by_time = options_.seconds > 0 ? now / options_.seconds : 0;
        progress.fraction = std::min(1.0, std::max(by_samples, by_time));
        const double begun = begun_ / progress.target_samples;
        progress.seconds_left =
            now * (1 - progress.fraction) / std::max(progress.fraction - begun, 1e-9);
        progress.rays_per_second = double(integrator_.ray_counts().total()) / std::max(now, 1e-9);
        report_(progress);
    }

  private:
    Integrator& integrator_;
    const SampledPixels& pixels_;
    const RenderOptions& options_;
    const std::function<void(const Progress&)>& report_;
    double interval_;
    double begun_; ///< samples that were there before
    double next_ = 0;
    Timer timer_;
};

/// Samples of the next pass: what is left of an interrupted one, or as many as one block takes.
uint32_t next_pass(const FilmExtent& held, uint32_t most, uint32_t target) {
    if (held.pixels > 0) return held.pass;
    const uint32_t left_in_block = FILM_BLOCK - held.end % FILM_BLOCK;
    return std::bit_floor(std::min({most, target - held.end, left_in_block}));
}

} // namespace

RenderOutcome render(Integrator& integrator, const RenderOptions& options,
                     const std::atomic<bool>& stop,
                     const std::function<void(const Progress&)>& report,
                     double reports_per_second) {
    SampledPixels pixels(integrator, options);
    Reporter reporter(integrator, pixels, options, report, reports_per_second);
    const Film& film = integrator.film();
    const uint32_t begun = film.extent().end;
    const auto time_left = [&] {
        return options.seconds <= 0 || film.extent().end == begun ||
               reporter.seconds() < options.seconds;
    };
    while (film.extent().end < options.samples && !stop && time_left() && pixels.choose()) {
        const uint32_t most = options.seconds > 0 ? 1 : integrator.max_samples();
        const uint32_t count = next_pass(film.extent(), most, options.samples);
        integrator.render_pass(film.extent().end, count, [&](double) {
            reporter.wave_done();
            return !stop;
        });
    }
    RenderOutcome outcome;
    outcome.samples = pixels.samples();
    outcome.interrupted = stop;
    outcome.seconds = reporter.seconds();
    reporter.wave_done(true);
    return outcome;
}

} // namespace onde
