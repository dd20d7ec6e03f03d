#include "render/traversal_cost.h"

#include "render/frame.h"

#include <glm/glm.hpp>

#include <algorithm>
#include <array>
#include <numeric>

namespace onde {

namespace {

constexpr size_t LOCAL_SIZE = 64;

gpu::ProgramRequest request(const IntegratorContext& context, size_t pixels) {
    gpu::ProgramRequest request{"inspect/traversal_cost.cl",
                                context.scene.packed().features.defines(),
                                {},
                                {layout_file(context.scene.packed().features.layout)}};
    request.defines.push_back("ONDE_WIDTH=1");
    request.defines.push_back("ONDE_TRAVERSAL_COST=1");
    request.kernels.push_back({"pixel_cost", LOCAL_SIZE, pixels});
    return request;
}

/// Linear light of a share of the largest count.
glm::vec3 heat(float share) {
    constexpr std::array<glm::vec3, 6> COLORS{{{0.0f, 0.0f, 0.0f},
                                               {0.02f, 0.02f, 0.35f},
                                               {0.4f, 0.0f, 0.35f},
                                               {0.8f, 0.1f, 0.02f},
                                               {1.0f, 0.6f, 0.02f},
                                               {1.0f, 1.0f, 1.0f}}};
    const float place = std::clamp(share, 0.0f, 1.0f) * float(COLORS.size() - 1);
    const size_t below = std::min(size_t(place), COLORS.size() - 2);
    return glm::mix(COLORS[below], COLORS[below + 1], place - float(below));
}

} // namespace

uint64_t TraversalCost::sum() const {
    return std::accumulate(boxes.begin(), boxes.end(), uint64_t(0)) +
           std::accumulate(primitives.begin(), primitives.end(), uint64_t(0));
}

uint32_t TraversalCost::largest() const {
    uint32_t largest = 0;
    for (size_t i = 0; i < boxes.size(); ++i) largest = std::max(largest, at(i));
    return largest;
}

TraversalCost measure_traversal_cost(const IntegratorContext& c) {
    const uint32_t width = c.options.width, height = c.options.height;
    const size_t pixels = size_t(width) * height;
    gpu::Program program = c.programs.build(request(c, pixels));
    const FrameRecord record = make_frame(c.scene.packed(), c.camera, c.options);
    const gpu::Buffer<FrameRecord> frame(c.device(), std::span(&record, 1));
    const gpu::Buffer<uint32_t> tests(c.device(), 2 * pixels);
    gpu::Kernel& kernel = program.kernel("pixel_cost");
    kernel.set_from(0, uint32_t(pixels), frame);
    kernel.set(c.scene.bind(kernel, 2), tests);
    kernel.launch(pixels, c.profiler);

    const std::vector<uint32_t> counts = tests.read(c.device());
    TraversalCost map{width, height, std::vector<uint32_t>(pixels), std::vector<uint32_t>(pixels)};
    for (size_t i = 0; i < pixels; ++i) {
        map.boxes[i] = counts[2 * i];
        map.primitives[i] = counts[2 * i + 1];
    }
    return map;
}

Image cost_numbers(const TraversalCost& map) {
    Image image(map.width, map.height, 3);
    for (size_t i = 0; i < map.boxes.size(); ++i) {
        image.pixels[3 * i] = float(map.boxes[i]);
        image.pixels[3 * i + 1] = float(map.primitives[i]);
        image.pixels[3 * i + 2] = float(map.at(i));
    }
    return image;
}

Image heat_picture(const TraversalCost& map) {
    Image image(map.width, map.height, 3);
    const float scale = 1.0f / float(std::max(map.largest(), 1u));
    for (size_t i = 0; i < map.boxes.size(); ++i) {
        const glm::vec3 color = heat(scale * float(map.at(i)));
        for (size_t k = 0; k < 3; ++k) image.pixels[3 * i + k] = color[k];
    }
    return image;
}

} // namespace onde
