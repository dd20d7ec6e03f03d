// Pictures by light tracing, and whether their mean is an expected one: a Z-test over blocks whose
// variance comes from pictures of several seeds.
#pragma once

#include "render/light_integrator.h"
#include "render/picture.h"
#include "support/reference/reference.h"

#include <fmt/format.h>

#include <cmath>

namespace onde::test {

struct LightPicture {
    Image image;
    LightCounts counts;
    Film::Invalid invalid;
};

inline LightPicture trace_light(const DeviceScene& placed, const Scene& scene,
                                const RenderOptions& options) {
    LightIntegrator integrator(
        {programs(), &scene, placed, scene.cameras.at(options.camera), options});
    const std::atomic<bool> never{false};
    render(integrator, options, never, [](const Progress&) {});
    return {integrator.film().develop(), integrator.counts(), integrator.film().find_invalid()};
}

/// Luminance per pixel and the variance of that number.
struct Expectation {
    uint32_t width = 0, height = 0;
    std::vector<double> mean, variance;
};

inline double luminance_of(const float* rgb) {
    return 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2];
}

/// The reference's picture. Channels are taken as fully correlated, which bounds the variance.
inline Expectation expect_reference(const Scene& scene, const ReferenceOptions& options) {
    const ReferenceResult result = ReferenceRenderer(scene).render(options);
    Expectation e{result.width, result.height, {}, {}};
    for (size_t i = 0; i < result.mean.size(); i++) {
        const glm::vec3 deviation = glm::sqrt(result.variance_of_mean[i]);
        e.mean.push_back(luminance_of(&result.mean[i].x));
        e.variance.push_back(std::pow(luminance_of(&deviation.x), 2));
    }
    return e;
}

/// The path tracer's picture, with the variance among eight seeds.
inline Expectation expect_paths(const Scene& scene, RenderOptions options) {
    constexpr uint32_t SEEDS = 8;
    const size_t pixels = size_t(options.width) * options.height;
    Expectation e{options.width, options.height, std::vector<double>(pixels),
                  std::vector<double>(pixels)};
    std::vector<double> square(pixels);
    const DeviceScene placed = place_on_device(scene);
    for (options.seed = 101; options.seed <= 100 + SEEDS; options.seed++) {
        const Image image = render_by(scene, placed, options).image;
        for (size_t i = 0; i < pixels; i++) {
            const double value = luminance_of(&image.pixels[3 * i]);
            e.mean[i] += value / SEEDS;
            square[i] += value * value / SEEDS;
        }
    }
    for (size_t i = 0; i < pixels; i++)
        e.variance[i] = std::max(square[i] - e.mean[i] * e.mean[i], 0.0) / (SEEDS - 1);
    return e;
}

/// Pixels whose filters touch a surface of `material`, which are not to be compared.
inline std::vector<bool> pixels_of(Scene scene, uint32_t material, RenderOptions options) {
    for (Material& m : scene.materials) m.emission = glm::vec3(0);
    scene.materials[material].emission = glm::vec3(1);
    scene.point_lights.clear();
    scene.directional_lights.clear();
    scene.environment = {};
    options.depth = 1;
    options.samples = 64;
    const Image image = render_scene(scene, options).image;
    std::vector<bool> touched;
    for (size_t i = 0; i < image.pixels.size(); i += 3) touched.push_back(image.pixels[i] > 0);
    return touched;
}

struct LightVerdict {
    bool accepted = false;
    double deviation = 0; ///< of the whole image's mean, as a share of it
    double difference = 0;
    std::string sentence;
};

/// Light tracing of `seeds` pictures against an expectation, over blocks of 8x8 pixels. With 16
/// seeds, 0.9% of blocks of a normal distribution lie beyond 3 (Student's t with 15 degrees); 2%
/// may, and four standard deviations of a count of that probability and one block. The whole image
/// must lie within 4.5 (less than one in a thousand).
inline LightVerdict compare_light(const std::vector<Image>& pictures, const Expectation& expected,
                                  const std::vector<bool>& masked = {}) {
    constexpr uint32_t BLOCK = 8;
    const uint32_t columns = (expected.width + BLOCK - 1) / BLOCK;
    const uint32_t rows = (expected.height + BLOCK - 1) / BLOCK;
    const size_t blocks = size_t(columns) * rows, seeds = pictures.size();
    // The last one is the whole picture.
    std::vector<double> mean(blocks + 1), variance(blocks + 1), sum(blocks + 1), square(blocks + 1);
    const auto each = [&](const auto& add) {
        for (uint32_t y = 0; y < expected.height; y++)
            for (uint32_t x = 0; x < expected.width; x++) {
                const size_t i = size_t(y) * expected.width + x;
                if (!masked.empty() && masked[i]) continue;
                add(i, size_t(y / BLOCK) * columns + x / BLOCK);
                add(i, blocks);
            }
    };
    each([&](size_t i, size_t block) {
        mean[block] += expected.mean[i];
        variance[block] += expected.variance[i];
    });
    for (const Image& picture : pictures) {
        std::vector<double> own(blocks + 1);
        each([&](size_t i, size_t block) { own[block] += luminance_of(&picture.pixels[3 * i]); });
        for (size_t b = 0; b <= blocks; b++) {
            sum[b] += own[b];
            square[b] += own[b] * own[b];
        }
    }
    const double n = double(seeds);
    const auto z = [&](size_t b) {
        const double average = sum[b] / n;
        const double spread = std::max(square[b] / n - average * average, 0.0) / (n - 1);
        const double rounding = 1e-5 * (std::abs(average) + std::abs(mean[b]));
        const double deviation = std::sqrt(variance[b] + spread + rounding * rounding);
        return deviation > 0 ? (average - mean[b]) / deviation : 0.0;
    };
    size_t outliers = 0, worst = 0;
    for (size_t b = 0; b < blocks; b++) {
        outliers += !(std::abs(z(b)) <= 3);
        if (!(std::abs(z(b)) <= std::abs(z(worst)))) worst = b;
    }
    const double bound = 0.02 * double(blocks) + 4 * std::sqrt(0.02 * 0.98 * double(blocks)) + 1;
    LightVerdict v;
    v.difference = sum[blocks] / n / mean[blocks] - 1;
    v.deviation = std::abs(v.difference / z(blocks));
    v.accepted = double(outliers) <= bound && std::abs(z(blocks)) <= 4.5;
    v.sentence = fmt::format("{} of {} blocks beyond 3 sigma (at most {:.1f}), image means {:.6g} "
                             "and {:.6g} ({:+.3f}%, z {:+.2f}), worst block at pixel ({}, {}) with "
                             "{:.6g} against {:.6g} (z {:+.2f})",
                             outliers, blocks, bound, sum[blocks] / n, mean[blocks],
                             100 * v.difference, z(blocks), worst % columns * BLOCK,
                             worst / columns * BLOCK, sum[worst] / n, mean[worst], z(worst));
    return v;
}

/// Sixteen pictures, of seeds 1 to 16.
inline std::vector<Image> trace_seeds(const Scene& scene, RenderOptions options) {
    check_scene(scene);
    const DeviceScene placed = place_on_device(scene);
    std::vector<Image> pictures;
    for (options.seed = 1; options.seed <= 16; options.seed++) {
        const LightPicture picture = trace_light(placed, scene, options);
        REQUIRE(picture.invalid.count == 0);
        pictures.push_back(picture.image);
    }
    return pictures;
}

/// That light tracing shows what paths from the camera find.
inline void check_paths_agree(const Scene& scene, const RenderOptions& options,
                              double most_deviation) {
    const LightVerdict verdict =
        compare_light(trace_seeds(scene, options), expect_paths(scene, options));
    INFO(verdict.sentence);
    CHECK(verdict.accepted);
    CHECK(verdict.deviation < most_deviation);
}

} // namespace onde::test
