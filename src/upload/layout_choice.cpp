#include "upload/layout_choice.h"

#include "core/files.h"
#include "core/hash.h"
#include "core/output.h"
#include "core/timer.h"

#include <algorithm>
#include <fstream>
#include <numbers>
#include <random>

namespace onde {

namespace {

/// A hilly field over [-1, 1] x [-1, 1].
struct Field {
    static constexpr uint32_t CELLS = 256;
    std::vector<glm::vec3> positions;
    std::vector<glm::uvec3> triangles;

    Field() {
        for (uint32_t row = 0; row <= CELLS; ++row)
            for (uint32_t column = 0; column <= CELLS; ++column) {
                positions.push_back(
                    at(2.0f * float(column) / CELLS - 1.0f, 2.0f * float(row) / CELLS - 1.0f));
                if (row == CELLS || column == CELLS) continue;
                const uint32_t a = row * (CELLS + 1) + column, b = a + CELLS + 1;
                triangles.emplace_back(a, b, a + 1);
                triangles.emplace_back(a + 1, b, b + 1);
            }
    }

    static glm::vec3 at(float x, float z) {
        return {x, 0.15f * std::sin(5 * x) * std::cos(4 * z) + 0.05f * std::sin(31 * x + 17 * z),
                z};
    }
};

/// Half from an eye above the field in rows of a picture, half from points just above it in any
/// direction.
std::vector<QueryRay> field_rays() {
    constexpr uint32_t SIDE = 512;
    const glm::vec3 eye(1.6f, 1.2f, 1.6f), forward = glm::normalize(-eye);
    const glm::vec3 right = glm::normalize(glm::cross(forward, glm::vec3(0, 1, 0)));
    const glm::vec3 up = glm::cross(right, forward);
    std::vector<QueryRay> rays;
    for (uint32_t i = 0; i < SIDE * SIDE; ++i) {
        const float x = (float(i % SIDE) + 0.5f) / SIDE - 0.5f;
        const float y = 0.5f - (float(i / SIDE) + 0.5f) / SIDE;
        rays.push_back({eye, 0.0f, forward + x * right + y * up, 1e30f});
    }
    std::mt19937 generator(1);
    const auto signed_unit = [&] { return float(generator() >> 8) * 0x1p-23f - 1.0f; };
    for (uint32_t i = 0; i < SIDE * SIDE; ++i) {
        const float x = signed_unit(), z = signed_unit();
        const float height = signed_unit(), turn = std::numbers::pi_v<float> * signed_unit();
        const float across = std::sqrt(1.0f - height * height);
        rays.push_back({Field::at(x, z) + glm::vec3(0, 1e-3f, 0),
                        0.0f,
                        {across * std::cos(turn), height, across * std::sin(turn)},
                        1e30f});
    }
    return rays;
}

double seconds_of(RayQuery& query, const QueryRays& rays) {
    double seconds[3];
    for (double& run : seconds) {
        const Timer timer;
        query.closest(rays);
        query.occluded(rays);
        run = timer.seconds();
    }
    std::ranges::sort(seconds);
    return seconds[1];
}

} // namespace

std::vector<BvhLayout> layouts_for(const gpu::DeviceFacts& facts) {
    std::vector<BvhLayout> layouts{BvhLayout::compressed, BvhLayout::binary};
    if (facts.keeps_vectors()) layouts.insert(layouts.begin(), BvhLayout::wide);
    return layouts;
}

std::vector<LayoutRate> measure_layouts(gpu::Programs& programs) {
    const Field field;
    const Geometry geometry{field.positions, field.triangles, {}, 0};
    const std::vector<QueryRay> set = field_rays();
    const QueryRays rays(programs.device(), set);
    std::vector<LayoutRate> rates;
    for (const BvhLayout layout : layouts_for(programs.device().facts())) {
        RayQuery query(programs, geometry, {.layout = layout});
        query.closest(rays); // for pages and caches to fill
        rates.push_back({layout, 2e-6 * double(set.size()) / seconds_of(query, rays)});
    }
    return rates;
}

BvhLayout fastest_layout(std::span<const LayoutRate> rates) {
    return std::ranges::max_element(rates, {}, &LayoutRate::mrays)->layout;
}

LayoutMemory::LayoutMemory(std::filesystem::path folder) : folder_(std::move(folder)) {}

std::filesystem::path LayoutMemory::path(const gpu::DeviceFacts& facts) const {
    Hasher hasher;
    hasher.text(facts.platform).text(facts.platform_version);
    hasher.text(facts.name).text(facts.driver_version);
    return folder_ / (hasher.hex() + ".layout");
}

std::optional<BvhLayout> LayoutMemory::recall(const gpu::DeviceFacts& facts) const {
    if (folder_.empty()) return std::nullopt;
    try {
        constexpr uint64_t LONGEST = 64;
        const std::string word = read_file(path(facts), LONGEST);
        return value_of<BvhLayout>(word);
    } catch (const std::exception&) { // never measured, or not by us
    }
    return std::nullopt;
}

void LayoutMemory::remember(const gpu::DeviceFacts& facts, BvhLayout layout) const {
    if (folder_.empty()) return;
    try {
        std::filesystem::create_directories(folder_);
        write_file(path(facts), word_of(layout));
    } catch (const std::exception&) { // a full or read-only disk only costs another measurement
    }
}

BvhLayout known_layout(const gpu::DeviceFacts& facts, const LayoutMemory& memory) {
    const std::vector<BvhLayout> layouts = layouts_for(facts);
    const BvhLayout known = memory.recall(facts).value_or(layouts.front());
    return std::ranges::find(layouts, known) == layouts.end() ? layouts.front() : known;
}

BvhLayout suitable_layout(gpu::Programs& programs,
                          const std::function<void(const std::string&)>& announce,
                          const LayoutMemory& memory) {
    const gpu::Device& device = programs.device();
    if (device.facts().keeps_vectors() || memory.recall(device.facts()))
        return known_layout(device.facts(), memory);
    if (announce)
        announce(fmt::format("measuring which tree suits {} (once)...", device.facts().name));
    const BvhLayout layout = fastest_layout(measure_layouts(programs));
    memory.remember(device.facts(), layout);
    return layout;
}

} // namespace onde
