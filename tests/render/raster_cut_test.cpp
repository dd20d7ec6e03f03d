// The depth buffer and the painter cut their work as for a GPU: a primitive, a pixel, a row of a
// tile a work item, in groups of 64. The same bits as when it is cut for a CPU.
#include "chapter/raster_painter.h"
#include "chapter/raster_sort.h"
#include "render/raster_picture.h"
#include "session/integrators.h"

#include <numeric>

namespace onde::test {
namespace {

/// The tests' device under facts that make it no CPU.
gpu::Device device_as_gpu() {
    gpu::DeviceFacts facts = device().facts();
    facts.is_cpu = false;
    return {device().raw(), facts};
}

Image draw_on(gpu::Programs& target, const Scene& scene, IntegratorKind kind) {
    PackedScene packed = pack_scene(scene);
    packed.features = all_features();
    const DeviceScene placed(target.device(), std::move(packed));
    RenderOptions options = raster_options(kind, 200, 150, 2);
    options.settings = gpu::default_settings(target.device().facts());
    const auto integrator =
        make_integrator({target, &scene, placed, scene.cameras[0], options, nullptr});
    integrator->render_pass(0, 2, [](double) { return true; });
    return integrator->film().develop();
}

} // namespace

TEST_CASE("work that is cut as for a GPU makes the same bits") {
    const gpu::Device device = device_as_gpu();
    gpu::Programs other(device, kernel_sources(), test_cache());
    Scene scene = random_raster_scene(9);
    for (uint32_t i = 0; i < scene.materials.size(); i += 2) {
        scene.materials[i].kind = MaterialKind::phong;
        scene.chapter.phong[i].transmission = 0.4f;
    }
    for (IntegratorKind kind : {IntegratorKind::depth_buffer, IntegratorKind::painter})
        CHECK(first_pixel_difference(draw_on(other, scene, kind),
                                     draw_on(programs(), scene, kind)) == "");
}

TEST_CASE("the radix sort in groups of 64 sorts") {
    const gpu::Device other = device_as_gpu();
    constexpr uint32_t COUNT = 70'001;
    Generator generator(2);
    std::vector<uint32_t> keys(COUNT), values(COUNT);
    for (uint32_t& key : keys) key = uint32_t(generator()) >> generator() % 32;
    std::iota(values.begin(), values.end(), 0u);
    gpu::Buffer<uint32_t> key_buffer(other, COUNT), value_buffer(other, COUNT);
    key_buffer.write(other, keys);
    value_buffer.write(other, values);
    gpu::Programs programs(other, kernel_sources());
    gpu::BufferList list(other);
    RadixSort(programs, SortBuffers(list, other.facts(), COUNT), COUNT, 64)
        .sort(key_buffer, value_buffer, COUNT);
    std::ranges::stable_sort(values, {}, [&](uint32_t v) { return keys[v]; });
    CHECK(value_buffer.read(other) == values);
}

} // namespace onde::test
