#include "chapter/leak_trials.h"

#include "core/timer.h"
#include "shared/items.h"
#include "upload/device_bvh.h"

#include <cmath>
#include <map>
#include <numeric>

namespace onde {

namespace {

/// Splits every triangle in four; midpoints of shared edges are shared.
void subdivide(TriangleSoup& soup) {
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
        const auto [known, is_new] =
            middles.try_emplace(std::minmax(a, b), uint32_t(soup.positions.size()));
        if (is_new) soup.positions.push_back(glm::normalize(soup.positions[a] + soup.positions[b]));
        return known->second;
    };
    std::vector<glm::uvec3> quarters;
    for (const glm::uvec3 t : soup.triangles) {
        const uint32_t ab = middle(t.x, t.y), bc = middle(t.y, t.z), ca = middle(t.z, t.x);
        for (const glm::uvec3 quarter : {glm::uvec3(t.x, ab, ca), glm::uvec3(ab, t.y, bc),
                                         glm::uvec3(ca, bc, t.z), glm::uvec3(ab, bc, ca)})
            quarters.push_back(quarter);
    }
    soup.triangles = std::move(quarters);
}

gpu::ProgramRequest request(const Bvh& bvh, size_t items) {
    return {"bench/leaks.cl",
            {fmt::format("ONDE_STACK_SIZE={}", bvh.stack_size), "ONDE_INSTANCES=0",
             "ONDE_SPHERES=0", fmt::format("ONDE_WATERTIGHT={:d}", bvh.watertight)},
            {{"count_leaks", 16, items}},
            {layout_file(bvh.layout)}};
}

} // namespace

TriangleSoup closed_ball(uint32_t subdivisions, glm::vec3 size) {
    TriangleSoup soup;
    soup.positions = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (const uint32_t x : {0u, 1u})
        for (const uint32_t y : {2u, 3u})
            for (const uint32_t z : {4u, 5u}) soup.triangles.emplace_back(x, y, z);
    for (uint32_t i = 0; i < subdivisions; ++i) subdivide(soup);
    for (glm::vec3& p : soup.positions)
        p *= size * (0.9f + 0.1f * std::sin(7 * p.x + 1) * std::cos(5 * p.y + 3 * p.z));
    return soup;
}

LeakTrials count_leaks(gpu::Programs& programs, uint32_t subdivisions, glm::vec3 size,
                       bool watertight, uint64_t rays) {
    const gpu::Device& device = programs.device();
    constexpr uint64_t MOST_ITEMS = 1u << 14;
    const TriangleSoup ball = closed_ball(subdivisions, size);
    const Geometry geometry{ball.positions, ball.triangles, {}, 0};
    const Placement placement;
    const Bvh bvh = build_bvh({&geometry, 1}, {&placement, 1}, {.watertight = watertight});
    const uint64_t items = (rays + LEAK_RAYS - 1) / LEAK_RAYS;
    gpu::Program program = programs.build(request(bvh, std::min(items, MOST_ITEMS)));

    const DeviceBvh tree(device, bvh);
    const gpu::Buffer<glm::vec3> positions(device, std::span<const glm::vec3>(ball.positions));
    const gpu::Buffer<glm::uvec3> triangles(device, std::span<const glm::uvec3>(ball.triangles));
    const gpu::Buffer<uint32_t> leaks(device, MOST_ITEMS);
    const glm::vec3 inside = 0.2f * size;
    gpu::Kernel& kernel = program.kernel("count_leaks");
    LeakTrials trials;
    const Timer timer;
    for (uint64_t first = 0; first < items; first += MOST_ITEMS) {
        const auto count = uint32_t(std::min(MOST_ITEMS, items - first));
        kernel.set_from(0, count);
        kernel.set_from(tree.bind(kernel, 1), positions, triangles, uint32_t(ball.triangles.size()),
                        inside.x, inside.y, inside.z, uint32_t(first), leaks);
        kernel.launch(count);
        const std::vector<uint32_t> counts = leaks.read(device, 0, count);
        trials.leaks += std::accumulate(counts.begin(), counts.end(), uint64_t(0));
        trials.rays += count * LEAK_RAYS;
    }
    trials.seconds = timer.seconds();
    return trials;
}

} // namespace onde
