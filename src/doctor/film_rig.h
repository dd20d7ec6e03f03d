// Films whose samples are made up, by the kernels of kernels/film.
#pragma once

#include "doctor/columns.h"
#include "render/film.h"

#include <algorithm>

namespace onde::doctor {

inline RenderOptions film_options(uint32_t width, uint32_t first_sample, uint32_t samples) {
    RenderOptions options;
    options.width = width;
    options.height = 1;
    options.samples = samples;
    options.first_sample = first_sample;
    return options;
}

/// A film of one row, for which no more than one sample was planned.
class FilmRig {
    const gpu::Device& device_;
    gpu::BufferList buffers_;

  public:
    Film film;

    FilmRig(gpu::Programs& programs, uint32_t width, uint32_t first_sample = 0)
        : device_(programs.device()), buffers_(device_),
          film(programs, buffers_, film_options(width, first_sample, first_sample + 1)),
          width_(width), program_(programs.build({"probe/film.cl", {}, {{"probe_film", 1}}})) {
        std::vector<uint32_t> order(width);
        for (uint32_t x = 0; x < width; x++) order[x] = x;
        order_ = gpu::Buffer<uint32_t>(device_, std::span<const uint32_t>(order));
    }

    /// The same samples go to all pixels.
    void add(const std::vector<float>& samples) {
        std::vector<cl_float4> radiance;
        for (uint32_t pixel = 0; pixel < width_; pixel++)
            for (const float value : samples) radiance.push_back({{value, 2 * value, -value, 0}});
        place(radiance);
        add_placed(uint32_t(samples.size()));
    }
    /// `samples` of each pixel, one after the other.
    void place(const std::vector<cl_float4>& radiance) {
        radiance_ = gpu::Buffer<cl_float4>(device_, std::span<const cl_float4>(radiance));
    }
    void add_placed(uint32_t samples) {
        film.begin_pass(film.extent().end, samples, width_);
        gpu::Kernel& kernel = program_.kernel("probe_film");
        kernel.set_from(0, width_, samples, order_, radiance_, film.sums(), film.invalid());
        kernel.launch(width_);
        film.end_wave(width_);
    }
    /// In passes that end where blocks do.
    void add_all(const std::vector<float>& samples) {
        for (auto at = samples.begin(); at != samples.end();) {
            const auto room = ptrdiff_t(FILM_BLOCK - film.extent().end % FILM_BLOCK);
            const auto end = at + std::min(room, samples.end() - at);
            add(std::vector<float>(at, end));
            at = end;
        }
    }

  private:
    uint32_t width_;
    gpu::Program program_;
    gpu::Buffer<uint32_t> order_;
    gpu::Buffer<cl_float4> radiance_;
};

inline std::vector<float> random_samples(size_t count, uint32_t seed) {
    Generator generator(seed);
    std::vector<float> samples(count);
    for (float& sample : samples) sample = 10 * unit(generator) * unit(generator);
    return samples;
}

/// The sum of samples first to end - 1 as the film's contract says it; `first` is a multiple of a
/// power of two of blocks that is no less than end - first.
inline float tree_sum(const std::vector<float>& samples, size_t first, size_t end) {
    float sum = 0;
    if (end - first <= FILM_BLOCK) {
        for (size_t i = first; i < end; i++) sum += samples[i];
        return sum;
    }
    size_t half = FILM_BLOCK;
    while (2 * half < end - first) half *= 2;
    return tree_sum(samples, first, first + half) + tree_sum(samples, first + half, end);
}

inline float mean_of(const std::vector<float>& samples) {
    return tree_sum(samples, 0, samples.size()) / float(samples.size());
}

} // namespace onde::doctor
