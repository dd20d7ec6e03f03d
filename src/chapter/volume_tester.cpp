#include "chapter/volume_tester.h"

#include "core/timer.h"
#include "shared/items.h"

namespace onde {

namespace {

constexpr size_t LOCAL_SIZE = 16;

constexpr std::array KERNELS{"test_box", "test_oriented_box", "test_few_slabs", "test_many_slabs",
                             "test_sphere"};

gpu::ProgramRequest request(uint32_t width) {
    gpu::ProgramRequest request{"chapter/volumes.cl", {fmt::format("ONDE_WIDTH={}", width)}, {}};
    for (const char* kernel : KERNELS) request.kernels.push_back({kernel, LOCAL_SIZE, 1u << 16});
    return request;
}

template <class T>
gpu::Buffer<T> copies_of(const gpu::Device& device, const T& value) {
    const std::vector<T> copies(VolumeTester::MOST_COPIES, value);
    return gpu::Buffer<T>(device, std::span<const T>(copies));
}

std::vector<float> columns_of(std::span<const VolumeRay> rays) {
    const size_t padded = (rays.size() + VOLUME_ITEMS - 1) / VOLUME_ITEMS * VOLUME_ITEMS;
    std::vector<float> columns(6 * padded);
    for (size_t i = 0; i < padded; ++i) {
        const VolumeRay& ray = rays[std::min(i, rays.size() - 1)];
        for (size_t k = 0; k < 3; ++k) {
            columns[k * padded + i] = ray.origin[glm::length_t(k)];
            columns[(3 + k) * padded + i] = ray.direction[glm::length_t(k)];
        }
    }
    return columns;
}

} // namespace

const char* volume_name(VolumeKind kind) {
    constexpr std::array NAMES{"box", "oriented box", "7 slabs", "13 slabs", "sphere"};
    return NAMES[size_t(kind)];
}

FittedVolumes fit_volumes(std::span<const glm::vec3> points) {
    return {fit_box(points), fit_oriented_box(points), fit_slabs(points), fit_sphere(points)};
}

VolumeMeasure measure_volume(const FittedVolumes& volumes, VolumeKind kind) {
    switch (kind) {
    case VolumeKind::box:
        return measure_volume(volumes.box);
    case VolumeKind::oriented_box:
        return measure_volume(volumes.oriented_box);
    case VolumeKind::few_slabs:
        return measure_volume(volumes.slabs, FEW_SLABS);
    case VolumeKind::many_slabs:
        return measure_volume(volumes.slabs, MANY_SLABS);
    case VolumeKind::sphere:
        break;
    }
    return measure_volume(volumes.sphere);
}

VolumeRays::VolumeRays(const gpu::Device& device, std::span<const VolumeRay> rays)
    : count_(rays.size()),
      columns_(device,
               std::span<const float>(rays.empty() ? std::vector<float>() : columns_of(rays))) {}

VolumeTester::VolumeTester(gpu::Programs& programs, const FittedVolumes& volumes, uint32_t width)
    : device_(programs.device()), boxes_(copies_of(device_, volumes.box)),
      oriented_boxes_(copies_of(device_, volumes.oriented_box)),
      slabs_(copies_of(device_, volumes.slabs)), spheres_(copies_of(device_, volumes.sphere)),
      program_(programs.build(request(width))) {}

void VolumeTester::launch(VolumeKind kind, const VolumeRays& rays, uint32_t copies,
                          const gpu::Buffer<uint32_t>& met) {
    gpu::Kernel& kernel = program_.kernel(KERNELS[size_t(kind)]);
    kernel.set_from(0, uint32_t(rays.padded()), rays.columns());
    if (kind == VolumeKind::box)
        kernel.set(2, boxes_);
    else if (kind == VolumeKind::oriented_box)
        kernel.set(2, oriented_boxes_);
    else if (kind == VolumeKind::sphere)
        kernel.set(2, spheres_);
    else
        kernel.set(2, slabs_);
    kernel.set_from(3, copies, met);
    kernel.launch(rays.padded() / VOLUME_ITEMS);
    device_.finish();
}

std::vector<uint32_t> VolumeTester::met(VolumeKind kind, const VolumeRays& rays) {
    const gpu::Buffer<uint32_t> met(device_, rays.padded());
    launch(kind, rays, 1, met);
    return met.read(device_, 0, rays.size());
}

double VolumeTester::seconds(VolumeKind kind, const VolumeRays& rays, uint32_t copies) {
    const gpu::Buffer<uint32_t> met(device_, rays.padded());
    const Timer timer;
    launch(kind, rays, copies, met);
    return timer.seconds();
}

} // namespace onde
