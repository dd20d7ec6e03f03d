#include "render/wave_integrator.h"

#include "gpu/fence.h"
#include "render/frame.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <deque>
#include <numeric>

namespace onde {

uint64_t RayCounts::total() const {
    return std::accumulate(extension.begin(), extension.end(), uint64_t(0)) +
           std::accumulate(shadow.begin(), shadow.end(), uint64_t(0));
}

static std::vector<uint64_t> counter_row(const std::vector<uint64_t>& table, uint32_t index) {
    const auto begin = table.begin() + index * COUNTER_BOUNCES;
    std::vector<uint64_t> counts(begin, begin + COUNTER_BOUNCES);
    while (!counts.empty() && counts.back() == 0) counts.pop_back();
    return counts;
}

RayCounts ray_counts_of(const std::vector<uint64_t>& counters) {
    return {counter_row(counters, COUNTER_EXTENSION), counter_row(counters, COUNTER_SHADOW)};
}

static const RenderOptions& checked(const RenderOptions& options) {
    check_options(options);
    return options;
}

WaveIntegrator::WaveIntegrator(const IntegratorContext& c, const MakeEstimator& make)
    : device_(c.device()), options_(checked(c.options)), camera_(c.camera), buffers_(c.device()),
      film_(c.programs, buffers_.film, options_), estimator_(make(buffers_)),
      engine_(make_engine({c.programs, buffers_, c.scene, film_, c.camera, options_, c.profiler},
                          *estimator_)),
      scene_(c.scene), pixels_(options_.width * options_.height) {
    if (options_.ids) order_ = pixel_order(options_.width, options_.height);
    if (options_.rectangle) set_pixels(pixel_order(*options_.rectangle));
}

void WaveIntegrator::set_pixels(std::span<const uint32_t> pixels) {
    engine_->set_pixels(pixels);
    pixels_ = uint32_t(pixels.size());
    if (options_.ids) order_.assign(pixels.begin(), pixels.end());
}

void WaveIntegrator::render_pass(uint32_t first, uint32_t count,
                                 const std::function<bool(double)>& keep_going) {
    constexpr size_t MOST_IN_FLIGHT = 2;
    const uint32_t step = std::min(count, max_samples());
    const uint32_t pixels_per_wave = engine_->wave_capacity() / step;
    std::deque<gpu::Fence> in_flight;
    bool goes_on = true;
    const uint32_t had = film_.begin_pass(first, count, pixels_);
    if (had >= pixels_) film_.end_wave(pixels_); // a film from outside
    for (uint32_t begin = had, end = 0; begin < pixels_ && goes_on; begin = end) {
        end = std::min(begin + pixels_per_wave, pixels_);
        for (uint32_t done = 0; done < count; done += step)
            queue_wave({begin, end - begin, first + done, step});
        film_.end_wave(end); // whoever reads the film waits in the same queue
        in_flight.emplace_back(device_);
        if (in_flight.size() < MOST_IN_FLIGHT && end < pixels_) continue;
        in_flight.front().wait();
        in_flight.pop_front();
        goes_on = keep_going(double(end) / pixels_);
    }
    device_.finish();
    end_pass();
}

void WaveIntegrator::queue_wave(const Wave& wave) {
    engine_->render_wave(wave);
    paths_ += wave.paths();
    if (options_.ids) count_ids(wave);
}

/// What a path has met, in words of the kernels.
static SeenId seen_id(const PackedScene& scene, const uint32_t* words) {
    const uint32_t primitive = words[SEEN_PRIMITIVE];
    if (primitive == NO_INDEX) return NOTHING_SEEN;
    return {scene.objects(primitive, words[SEEN_INSTANCE]),
            SURFACE_MATERIAL(scene.surfaces[primitive].any.tag)};
}

void WaveIntegrator::count_ids(const Wave& wave) {
    const std::vector<uint32_t> seen = engine_->seen(wave.paths());
    const PackedScene& scene = scene_.packed();
    tbb::parallel_for(0u, wave.pixels, [&](uint32_t i) {
        const uint32_t place = order_[wave.first_pixel + i];
        PixelIds& ids = film_.ids()[size_t(place >> 16) * options_.width + (place & 0xffff)];
        const uint32_t* words = &seen[size_t(i) * wave.samples * SEEN_WORDS];
        for (uint32_t sample = 0; sample < wave.samples; sample++, words += SEEN_WORDS)
            if (words[SEEN_PRIMITIVE] != SEEN_REJECTED) add_id(ids, seen_id(scene, words), 1);
    });
}

void WaveIntegrator::clear() {
    engine_->begin_picture(camera_);
    estimator_->clear(device_);
    film_.clear();
    paths_ = 0;
}

bool WaveIntegrator::set_camera(const Camera& camera) {
    camera_ = camera;
    clear();
    return true;
}

uint32_t WaveIntegrator::max_samples() const {
    return std::bit_floor(std::min(
        {options_.samples_in_flight, engine_->sample_capacity(), engine_->wave_capacity()}));
}

} // namespace onde
