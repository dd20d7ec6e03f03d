#include "build_contenders.h"

#include "build_heap.h"
#include "embree_scene.h"

#include <cmath>
#include <limits>

namespace onde::bench {

namespace {

/// The laboratory's trees take up to 1.6 kilobytes a triangle, and more while they are built.
constexpr uint64_t ANY = std::numeric_limits<uint64_t>::max(), LABORATORY = 2'000'000;

template <class T>
uint64_t bytes_of(const T& values) {
    return values.size() * sizeof(values[0]);
}

BuiltTree build_onde(BvhBuilder builder, const Model& model, Measure measure) {
    const Geometry geometry = model.geometry();
    const Placement placement;
    std::optional<HeapMeter> meter;
    if (measure == Measure::memory) meter.emplace();
    const Bvh tree = build_bvh({&geometry, 1}, {&placement, 1}, {.builder = builder});
    return {tree.statistics.build_seconds, bytes_of(tree.nodes) + bytes_of(tree.blocks),
            meter ? meter->peak_bytes() : 0, tree.statistics.sah_cost};
}

/// Of a tree around the model before it was twisted to what it is.
BuiltTree refit_onde(const Model& model, Measure measure) {
    const Geometry geometry = model.geometry();
    const Placement placement;
    std::vector<glm::vec3> before = model.positions;
    const float turn = 0.2f / std::max(model.high.y - model.low.y, 1e-30f);
    for (glm::vec3& position : before) {
        const float angle = turn * (position.y - model.low.y);
        const float cosine = std::cos(angle), sine = std::sin(angle);
        position = {cosine * position.x + sine * position.z, position.y,
                    cosine * position.z - sine * position.x};
    }
    const Geometry untwisted{before, geometry.triangles, {}, 0};
    Bvh tree = build_bvh({&untwisted, 1}, {&placement, 1});
    std::optional<HeapMeter> meter;
    if (measure == Measure::memory) meter.emplace();
    refit_bvh(tree, {&geometry, 1}, {&placement, 1});
    const uint64_t bytes = bytes_of(tree.nodes) + bytes_of(tree.blocks);
    return {tree.statistics.build_seconds, bytes, meter ? bytes + meter->peak_bytes() : 0,
            tree.statistics.sah_cost};
}

BuiltTree build_embree(RTCBuildQuality quality, const Model& model) {
    const EmbreeScene scene(model, quality);
    return {scene.build_seconds(), scene.bytes(), scene.peak_bytes(), std::nullopt};
}

Builder onde(const char* name, uint64_t most_triangles, BvhBuilder builder) {
    return {name, most_triangles, [builder](const Model& model, Measure measure) {
                return build_onde(builder, model, measure);
            }};
}

Builder embree(const char* name, RTCBuildQuality quality) {
    return {name, ANY,
            [quality](const Model& model, Measure) { return build_embree(quality, model); }};
}

} // namespace

std::vector<Builder> all_builders() {
    return {onde("onde sah", ANY, BvhBuilder::sah),
            onde("onde high", ANY, BvhBuilder::high),
            {"onde refit", ANY, refit_onde},
            onde("onde median", LABORATORY, BvhBuilder::median),
            onde("onde median-spatial", LABORATORY, BvhBuilder::median_spatial),
            embree("embree low", RTC_BUILD_QUALITY_LOW),
            embree("embree medium", RTC_BUILD_QUALITY_MEDIUM),
            embree("embree high", RTC_BUILD_QUALITY_HIGH)};
}

} // namespace onde::bench
