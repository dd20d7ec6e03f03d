#include "render/sampled_pixels.h"

#include "core/error.h"
#include "render/frame.h"

#include <algorithm>
#include <bit>

namespace onde {
namespace {

/// Whether a film of so many blocks is judged: often enough to save samples, seldom enough that no
/// pixel is sure by chance.
bool is_judged(uint32_t blocks) {
    if (blocks == 0) return false;
    const uint32_t odd = blocks >> std::countr_zero(blocks);
    return odd == 1 || odd == 3;
}

/// Samples of a pixel, before anything is known.
constexpr double FIRST_GUESS = 4 * FILM_BLOCK;

/// Sums of a film's whole blocks, of what its noise is told from.
struct WholeBlocks {
    uint32_t width, height;
    FilmSums radiance, halves;

    explicit WholeBlocks(const Film& film)
        : width(film.width()), height(film.height()), radiance(film.whole_blocks(RADIANCE_SUMS)),
          halves(film.whole_blocks(AOV_HALVES)) {}

    NoiseSums sums() const { return {width, height, radiance, halves}; }
};

NoiseTarget target_of(const RenderOptions& options) {
    return {options.noise, options.noise_exposure};
}

Rectangle window_of(const RenderOptions& options) {
    return options.rectangle.value_or(Rectangle{0, 0, options.width, options.height});
}

} // namespace

NoiseReport noise_report(const Film& film, const RenderOptions& options) {
    const WholeBlocks blocks(film);
    const NoiseEstimate estimate(blocks.sums(), target_of(options));
    NoiseReport report{.share = estimate.share()};
    float most = 0; // of whole blocks
    for (const cl_float4& sum : blocks.radiance) most = std::max(most, sum.s[3]);
    report.is_met = most > 0;
    for (size_t i = 0; i < blocks.radiance.size(); i++)
        if (blocks.radiance[i].s[3] == most) report.is_met = report.is_met && estimate.is_sure(i);
    for (const float samples : film.develop(SAMPLE_COUNT).pixels) {
        if (samples == 0) continue;
        report.most = std::max<double>(report.most, samples);
        report.fewest = report.fewest > 0 ? std::min<double>(report.fewest, samples) : samples;
    }
    return report;
}

SampledPixels::SampledPixels(Integrator& integrator, const RenderOptions& options)
    : integrator_(integrator), options_(options), all_(window_of(options).pixels()) {
    if (options.noise > 0) pixels_ = pixel_order(window_of(options));
    choose();
}

bool SampledPixels::choose() {
    if (options_.noise <= 0) return true;
    const uint32_t blocks = integrator_.film().extent().end / FILM_BLOCK;
    const bool is_known = blocks_ && (*blocks_ == blocks || !is_judged(blocks));
    if (!is_known) choose_from(blocks);
    return !pixels_.empty();
}

void SampledPixels::choose_from(uint32_t blocks) {
    blocks_ = blocks;
    integrator_.set_pixels(pixels_);
    if (blocks == 0) return;
    const WholeBlocks whole(integrator_.film());
    const NoiseEstimate estimate(whole.sums(), target_of(options_));
    const auto is_done = [&](uint32_t pixel) {
        const size_t i = size_t(pixel >> 16) * whole.width + (pixel & 0xffff);
        // One that was left out before has a block less. Samples that were not finite are not
        // counted either.
        const bool was_left = whole.radiance[i].s[3] <= float(FILM_BLOCK) * float(blocks - 1);
        return was_left || (is_judged(blocks) && estimate.is_sure(i));
    };
    std::erase_if(pixels_, is_done);
    if (!pixels_.empty()) integrator_.set_pixels(pixels_);
    had_ = needs_ = 0;
    for (size_t i = 0; i < whole.radiance.size(); i++) had_ += whole.radiance[i].s[3];
    for (const uint32_t pixel : pixels_) {
        const size_t i = size_t(pixel >> 16) * whole.width + (pixel & 0xffff);
        const double samples = whole.radiance[i].s[3], most = options_.samples;
        needs_ += std::clamp(samples * estimate.need(i), samples + FILM_BLOCK, most) - samples;
    }
}

/// Since the pixels were chosen.
static double samples_since(const Film& film, uint32_t blocks) {
    return film.samples() - double(blocks) * FILM_BLOCK;
}

double SampledPixels::samples() const {
    const Film& film = integrator_.film();
    if (!blocks_) return film.samples();
    return (had_ + samples_since(film, *blocks_) * double(pixels_.size())) / double(all_);
}

double SampledPixels::samples_at_end() const {
    if (!blocks_) return options_.samples - options_.first_sample;
    if (*blocks_ == 0) return std::min<double>(options_.samples, FIRST_GUESS);
    return std::max((had_ + needs_) / double(all_), samples());
}

} // namespace onde
