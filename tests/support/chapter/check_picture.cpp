#include "support/chapter/check_picture.h"

#include "support/chapter/trace.h"

#include <fmt/format.h>

#include <atomic>
#include <thread>

namespace onde::chapter {
namespace {

using glm::dvec2;
using glm::dvec3;

struct Comparison {
    const Image& picture;
    const Tracer tracer;
    const uint32_t samples;
    const double tolerance;

    glm::uvec2 size() const { return {picture.width, picture.height}; }

    bool on_silhouette(glm::uvec2 at, uint64_t structure) const {
        for (const double radius : {0.001, 0.01, 0.1})
            for (int i = 0; i < 8; ++i) {
                const double angle = M_PI / 4 * i;
                const dvec2 shift = radius * dvec2(std::cos(angle), std::sin(angle));
                if (tracer.pixel(size(), at, samples, shift).structure != structure) return true;
            }
        return false;
    }

    void compare(glm::uvec2 at, PictureCheck& into) const {
        const float* rgb = &picture.pixels[3 * (size_t(at.y) * picture.width + at.x)];
        const dvec3 seen(rgb[0], rgb[1], rgb[2]);
        const Seen expected = tracer.pixel(size(), at, samples);
        double error = 0;
        for (int i = 0; i < 3; ++i)
            error = std::max(error, std::abs(seen[i] - expected.colour[i]) /
                                        std::max(1.0, expected.colour[i]));
        ++into.pixels;
        if (!(error <= tolerance)) {
            if (on_silhouette(at, expected.structure)) {
                ++into.silhouettes;
                return;
            }
            ++into.wrong;
        }
        if (error <= into.worst) return;
        into.worst = error;
        into.worst_pixel =
            fmt::format("{},{}: ({}, {}, {}) against ({}, {}, {})", at.x, at.y, seen.x, seen.y,
                        seen.z, expected.colour.x, expected.colour.y, expected.colour.z);
    }
};

void join(PictureCheck& whole, const PictureCheck& part) {
    whole.pixels += part.pixels;
    whole.silhouettes += part.silhouettes;
    whole.wrong += part.wrong;
    if (part.worst <= whole.worst) return;
    whole.worst = part.worst;
    whole.worst_pixel = part.worst_pixel;
}

} // namespace

PictureCheck check_picture(const Image& picture, const Scene& scene, uint32_t samples,
                           uint32_t depth, double tolerance) {
    const Comparison comparison{picture, Tracer(scene, depth), samples, tolerance};
    std::atomic<uint32_t> next_row = 0;
    std::vector<PictureCheck> parts(std::max(1u, std::thread::hardware_concurrency()));
    {
        std::vector<std::jthread> threads;
        for (PictureCheck& part : parts)
            threads.emplace_back([&] {
                for (uint32_t y; (y = next_row++) < picture.height;)
                    for (uint32_t x = 0; x < picture.width; ++x) comparison.compare({x, y}, part);
            });
    }
    PictureCheck whole;
    for (const PictureCheck& part : parts) join(whole, part);
    return whole;
}

} // namespace onde::chapter
